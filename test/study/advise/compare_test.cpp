// SPDX-License-Identifier: MIT
#include "study/advise/compare.hpp"

#include "study/advise/study_chart.hpp"
#include "study/sweep.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace compare_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

/// A store of models with their values per replication, and seconds of CPU.
Store made(const std::string& path, const std::vector<std::string>& models,
           const std::vector<std::vector<std::optional<double>>>& values) {
    Store store = Store::open_to_write(path);
    std::vector<StoredPoint> points;
    for (std::uint32_t i = 0; i < models.size(); ++i) {
        Table settings;
        settings.set("propagation.model", models[i]);
        points.push_back({i, models[i], settings});
    }
    store.set_points(points);
    for (std::uint32_t i = 0; i < models.size(); ++i) {
        for (std::uint32_t r = 0; r < values[i].size(); ++r) {
            StoredRun run{};
            run.id = models[i] + std::to_string(r);
            run.point = i;
            run.replication = r;
            run.measurement.metrics = {{"reach", values[i][r]}};
            run.measurement.cpu_s = 1.0 + i;
            store.record(run);
        }
    }
    return store;
}

/// A store of protocols with their delivery ratios and airtimes for a byte, by replication.
Store made_of_protocols(const std::string& path, const std::vector<std::string>& protocols,
                        const std::vector<std::vector<double>>& deliveries,
                        const std::vector<std::vector<std::optional<double>>>& airtimes) {
    Store store = Store::open_to_write(path);
    std::vector<StoredPoint> points;
    for (std::uint32_t i = 0; i < protocols.size(); ++i) {
        Table settings;
        settings.set("routing.protocol", protocols[i]);
        points.push_back({i, protocols[i], settings});
    }
    store.set_points(points);
    for (std::uint32_t i = 0; i < protocols.size(); ++i) {
        for (std::uint32_t r = 0; r < deliveries[i].size(); ++r) {
            StoredRun run{};
            run.id = protocols[i] + std::to_string(r);
            run.point = i;
            run.replication = r;
            run.measurement.metrics = {{"delivery_ratio", deliveries[i][r]},
                                       {"airtime_per_byte_us", airtimes[i][r]}};
            store.record(run);
        }
    }
    return store;
}

constexpr double rounding = 1e-12;  // of means of a few numbers below 10

}  // namespace

TEST_CASE(
    "compare: differences are paired by replication; a model's error is its mean absolute "
    "difference from the most detailed model") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), {"raytrace_2007", "disc", "friis"},
                             {{0.2, 0.4, 0.6}, {0.3, 0.3, 0.9}, {1.0, 1.0, 1.0}});
    const Comparison c = compare_models(store, "reach", "disc");
    CHECK(c.most_detailed == "raytrace_2007");  // last in the list, first in the study
    CHECK(c.baseline == "disc");
    REQUIRE(c.models.size() == 3);
    const ComparedModel& ray = c.models[0];
    CHECK(std::abs(*ray.answer.value - 0.4) < rounding);
    CHECK(ray.error == 0);
    CHECK(ray.cpu_s == 1);
    CHECK(std::abs(ray.difference->difference.mean - (-0.1)) < rounding);
    CHECK(ray.sentence.find("between raytrace_2007 and disc") != std::string::npos);
    CHECK_FALSE(c.models[1].difference);
    CHECK(c.models[1].sentence.empty());
    CHECK(std::abs(*c.models[1].error - (0.1 + 0.1 + 0.3) / 3) < rounding);
    CHECK(ray.difference->family == 2);
    CHECK(c.models[2].difference->family == 2);
    // var(ray) = 0.04, var(disc) = 0.12, var(ray - disc) = 0.04
    REQUIRE(c.pairs.size() == 3);
    CHECK(std::abs(*c.pairs[0].ratio - (0.04 + 0.12) / 0.04) < 1e-9);
}

TEST_CASE(
    "compare: a mean uses all replications of a model; a difference uses only those of both "
    "compared models") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), {"disc", "friis", "itu_indoor"},
                             {{0.2, {}, 0.6, 0.9}, {1.0, 1.0, 0.8}, {0.1, 0.2, 0.3, 0.5}});
    const Comparison c = compare_models(store, "reach", "friis");
    const Answers results = answers(store, {.metrics = {"reach"}});
    const std::vector<std::size_t> n = {3, 3, 4};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(c.models[i].answer.value == results.list[i].value);
        CHECK(c.models[i].answer.low == results.list[i].low);
        CHECK(c.models[i].answer.values.size() == n[i]);
    }
    CHECK(c.models[0].difference->difference.n == 2);
    CHECK(std::abs(c.models[0].difference->difference.mean - (0.4 - 0.9)) < rounding);
    CHECK(c.models[0].unpaired.undefined == 1);
    CHECK(c.models[0].unpaired.missing == 1);
    CHECK(c.models[2].difference->difference.n == 3);
    CHECK(c.models[2].unpaired.missing == 1);
    CHECK(c.models[0].error_n == 3);  // to itu_indoor
    CHECK_THROWS_WITH_AS(compare_models(store, "reach", "disk"),
                         doctest::Contains("did you mean \"disc\"?"), std::invalid_argument);
}

TEST_CASE(
    "compare: for models without a common replication, means are given, but differences are not "
    "computed") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("n.db"), {"disc", "friis"}, {{{}, 1.0}, {0.5, {}}});
    const Comparison c = compare_models(store, "reach", "");
    CHECK(c.models[0].answer.value == 1.0);
    CHECK_FALSE(c.models[0].difference);
    CHECK_FALSE(c.models[0].error);
    CHECK(c.models[0].sentence.empty());
    CHECK(c.models[0].unpaired.undefined == 2);
}

TEST_CASE(
    "compare: with one replication, means and wide intervals are given, but differences are not "
    "tested") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), {"disc", "friis"}, {{0.5}, {1.0}});
    const Comparison c = compare_models(store, "reach", "");
    CHECK(c.models[0].answer.value == 0.5);
    CHECK(*c.models[0].answer.low < 0.1);
    CHECK(*c.models[0].answer.high > 0.9);
    CHECK_FALSE(c.models[0].difference);
    CHECK(c.models[0].error == 0.5);
}

TEST_CASE("compare: charts show each model's value, and its error against its cost") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), {"disc", "friis"}, {{0.2, 0.4}, {1.0, 1.0}});
    const auto charts = comparison_charts(compare_models(store, "reach", ""));
    REQUIRE(charts.size() == 2);
    CHECK(charts[0].series[0].points[0].category == "disc");
    CHECK(std::abs(charts[0].series[0].points[0].y - 0.3) < rounding);
    CHECK(charts[1].series[0].points[0].label == "disc");
    CHECK(charts[1].series[0].points[0].x == 1000);  // [ms]
    CHECK(std::abs(charts[1].series[0].points[0].y - 0.7) < rounding);
    CHECK(charts[1].series[0].points[1].y == 0);
}

TEST_CASE(
    "compare: in the example `rescue`, common random numbers halve the variance of differences") {
    const TemporaryFolder folder;
    const Array models = {"disc", "friis", "itu_indoor", "log_distance", "raytrace_2007"};
    Study study(ROVERNET_EXAMPLES "/rescue/study.toml", {.set = {"study.replications=100"}},
                std::vector<Vary>{{"propagation.model", {}, models}});
    Store store = open_store(folder.path("s.db"), study);
    REQUIRE(sweep(study, store, {}).progress.failed == 0);
    const Comparison c = compare_models(store, "delivery_ratio", "");
    int compared = 0;
    for (const PairedVariance& pair : c.pairs) {
        const auto varies = [&](const std::string& name) {
            const auto found = std::find_if(c.models.begin(), c.models.end(),
                                            [&](const auto& m) { return m.model == name; });
            return *found->answer.summary->standard_deviation > 0;
        };
        if (!varies(pair.a) || !varies(pair.b)) continue;
        CAPTURE(pair.a);
        CAPTURE(pair.b);
        CHECK(*pair.ratio >= 2);
        ++compared;
    }
    CHECK(compared == 3);
}

TEST_CASE(
    "compare: if a margin is given, each model is within the margin, outside it, or undecided") {
    const TemporaryFolder folder;
    std::vector<std::vector<std::optional<double>>> values(4);
    for (int r = 0; r < 400; ++r) {
        const double friis = 0.5 + 0.001 * (r % 7);
        values[0].push_back(friis + 0.002 * (r % 3 - 1));          // as good
        values[1].push_back(friis + 0.3);                          // not so
        values[2].push_back(friis + (r % 2 == 0 ? 0.44 : -0.36));  // who knows
        values[3].push_back(friis);
    }
    const Store store =
        made(folder.path("s.db"), {"disc", "two_ray", "log_distance", "friis"}, values);
    const Comparison c = compare_models(store, "reach", "friis", 0.05);
    CHECK(c.models[0].equivalence->verdict == Equivalence::within);
    CHECK(c.models[1].equivalence->verdict == Equivalence::outside);
    CHECK(c.models[2].equivalence->verdict == Equivalence::undecided);
    CHECK_FALSE(c.models[3].equivalence);
    CHECK(c.models[0].equivalence_sentence.starts_with(
        "disc is within 0.05 of friis (95 % for all 3 comparisons"));
    CHECK_FALSE(compare_models(store, "reach", "friis").models[0].equivalence);
}

TEST_CASE("compare: with several metrics the intervals are wider, to be valid simultaneously") {
    const TemporaryFolder folder;
    const Store store =
        made_of_protocols(folder.path("s.db"), {"flood", "aodv", "other"},
                          {{0.2, 0.4, 0.3, 0.3}, {0.9, 0.8, 0.7, 0.9}, {0.5, 0.6, 0.4, 0.7}},
                          {{500, 400, 450, 470}, {100, 110, 90, 120}, {200, 240, 260, 210}});
    const auto all = comparisons_of(store, {"delivery_ratio", "airtime_per_byte_us"}, "flood");
    REQUIRE(all.size() == 2);
    CHECK(all[0].path == "routing.protocol");
    CHECK(all[1].metric == "airtime_per_byte_us");
    CHECK(all[0].models[1].model == "aodv");
    CHECK_FALSE(all[0].models[0].difference);
    CHECK(std::abs(all[0].models[1].difference->difference.mean - 0.525) < rounding);
    // Four differences, of which each alone holds with less confidence: the interval is wider.
    const Comparison alone = compare_models(store, "airtime_per_byte_us", "flood");
    const auto width = [](const Comparison& c) {
        return c.models[1].difference->high - c.models[1].difference->low;
    };
    CHECK(width(all[1]) > 1.1 * width(alone));
    CHECK(all[1].models[1].sentence.find("for all 4 comparisons:") != std::string::npos);
    CHECK(alone.models[1].sentence.find("for all 2 comparisons:") != std::string::npos);
}

TEST_CASE(
    "chart: each protocol is a mark with intervals in x and y; a protocol without deliveries has "
    "no mark") {
    const TemporaryFolder folder;
    const Store store = made_of_protocols(folder.path("s.db"), {"flood", "aodv", "mute"},
                                          {{0.2, 0.4, 0.3}, {0.9, 0.8, 0.7}, {0, 0, 0}},
                                          {{500, 400, 450}, {100, 110, 90}, {{}, {}, {}}});
    const Chart chart = protocol_chart(store, {"fixed as in the file: radio.power = 15 dBm"});
    REQUIRE(chart.series.size() == 1);
    const auto& marks = chart.series[0].points;
    REQUIRE(marks.size() == 2);
    CHECK(marks[1].label == "aodv");
    CHECK(std::abs(marks[1].x - 100) < rounding);
    CHECK(std::abs(marks[1].y - 0.8) < rounding);
    CHECK(*marks[1].x_low < 100);
    CHECK(*marks[1].x_high > 100);
    CHECK(*marks[1].low < 0.8);
    CHECK(*marks[1].high > 0.8);
    CHECK(chart.y_limits.high == 1);
    CHECK(chart.note.find("nothing delivered by: mute; fixed as in the file") != std::string::npos);
}

}  // namespace compare_test
