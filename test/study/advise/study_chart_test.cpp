// SPDX-License-Identifier: MIT
#include "study/advise/study_chart.hpp"

#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>

namespace study_chart_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

using Texts = std::vector<std::string>;

/// Every combination of two keys' values, three replications: 10 * (place of the first) + place of
/// the second + replication / 10.
Store made(const std::string& path, const std::string& a, const std::vector<Value>& as,
           const std::string& b, const std::vector<Value>& bs) {
    Store store = Store::open_to_write(path);
    std::vector<StoredPoint> points;
    for (const Value& x : as) {
        for (const Value& y : bs) {
            Table settings;
            settings.set(a, x);
            settings.set(b, y);
            const auto number = static_cast<std::uint32_t>(points.size());
            points.push_back({number, std::to_string(number), settings});
        }
    }
    store.set_points(points);
    for (const StoredPoint& point : points) {
        for (std::uint32_t r = 0; r < 3; ++r) {
            StoredRun run{};
            run.id = point.id + "/" + std::to_string(r);
            run.point = point.number;
            run.replication = r;
            const auto columns = static_cast<std::uint32_t>(bs.size());
            const double value = 10.0 * (point.number / columns) + point.number % columns + 0.1 * r;
            run.measurement.metrics = {{"latency_mean_s", value}};
            store.record(run);
        }
    }
    return store;
}

constexpr double rounding = 1e-12;  // of a mean of three numbers below 100

}  // namespace

TEST_CASE(
    "study chart: numeric x values give lines, and values are averaged over keys that are not "
    "drawn") {
    const TemporaryFolder folder;
    const Store store =
        made(folder.path("s.db"), "robot.r.count", {10, 20}, "routing.ttl", {1, 2, 3});
    const Chart chart = study_chart(store, {.x = "robots", .y = "latency_mean_s"});
    CHECK(chart.kind == ChartKind::lines);
    CHECK(chart.x_label == "robot.r.count");
    CHECK(chart.y_label == "latency_mean [s]");
    CHECK(chart.note ==
          "means of 3 replications, with 95 % intervals by Student's t; averaged over routing.ttl");
    REQUIRE(chart.series.size() == 1);
    REQUIRE(chart.series[0].points.size() == 2);
    CHECK(chart.series[0].points[1].x == 20);
    CHECK(std::abs(chart.series[0].points[1].y - (10 + 1 + 0.1)) < rounding);
    CHECK(chart.series[0].points[1].n == 3);
    CHECK(*chart.series[0].points[1].low < chart.series[0].points[1].y);
}

TEST_CASE("study chart: each value of the key that `by` names has its own series") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), "radio.power", {"5 dBm", "10 dBm"},
                             "propagation.model", {"disc", "friis"});
    const Chart chart = study_chart(store, {.x = "power", .y = "latency_mean_s", .by = "model"});
    CHECK(chart.x_label == "radio.power [dBm]");
    REQUIRE(chart.series.size() == 2);
    CHECK(chart.series[1].name == "friis");
    CHECK(chart.legend_title == "model");
    CHECK(chart.series[1].points[1].x == 10);
    CHECK(std::abs(chart.series[1].points[1].y - 11.1) < rounding);
    const Chart words = study_chart(store, {.x = "model", .y = "latency_mean_s", .by = "power"});
    CHECK(words.kind == ChartKind::bars);
    CHECK(words.series[0].name == "5 dBm");
    CHECK(words.series[0].points[1].category == "friis");
}

TEST_CASE("study chart: quantities in several units are drawn in their base unit") {
    const TemporaryFolder folder;
    const Store store =
        made(folder.path("s.db"), "traffic.0.every", {"2 s", "500 ms"}, "routing.ttl", {1});
    const Chart chart = study_chart(store, {.x = "every", .y = "latency_mean_s"});
    CHECK(chart.x_label == "traffic.0.every [s]");
    CHECK(chart.series[0].points[0].x == 2);
    CHECK(chart.series[0].points[1].x == 0.5);
    // A mix of what cannot be compared is words.
    const Store mixed = made(folder.path("m.db"), "a.b", {"2 s", "500 m"}, "routing.ttl", {1});
    CHECK(study_chart(mixed, {.x = "b", .y = "latency_mean_s"}).kind == ChartKind::bars);
}

TEST_CASE(
    "study chart: a cdf has a point per replication; a heat map has a row per value of the `by` "
    "key") {
    const TemporaryFolder folder;
    const Store store =
        made(folder.path("s.db"), "robot.r.count", {10, 20}, "routing.ttl", {1, 2, 3});
    const Chart cdf =
        study_chart(store, {.kind = ChartKind::cdf, .y = "latency_mean_s", .by = "ttl"});
    REQUIRE(cdf.series.size() == 3);
    REQUIRE(cdf.series[2].points.size() == 3);
    CHECK(std::abs(cdf.series[2].points[2].x - (5 + 2 + 0.2)) < rounding);
    CHECK(cdf.x_label == "latency_mean [s]");
    const Chart all = study_chart(store, {.kind = ChartKind::cdf, .y = "latency_mean_s"});
    REQUIRE(all.series.size() == 1);
    CHECK(std::abs(all.series[0].points[0].x - 6) < rounding);
    const Chart map = study_chart(
        store, {.kind = ChartKind::heat_map, .x = "ttl", .y = "latency_mean_s", .by = "robots"});
    REQUIRE(map.series.size() == 2);
    CHECK(map.y_label == "robot.r.count");
    CHECK(map.value_label == "latency_mean [s]");
    CHECK(std::abs(map.series[1].points[2].y - 12.1) < rounding);
}

TEST_CASE(
    "study chart: a condition such as ttl=3 selects points, and the chart's note states the "
    "condition") {
    const TemporaryFolder folder;
    const Store store =
        made(folder.path("s.db"), "robot.r.count", {10, 20}, "routing.ttl", {1, 2, 3});
    const Chart chart =
        study_chart(store, {.x = "robots",
                            .y = "latency_mean_s",
                            .where = conditions_of({"robot.r.count", "routing.ttl"}, {"ttl=3"})});
    CHECK(std::abs(chart.series[0].points[1].y - (10 + 2 + 0.1)) < rounding);
    CHECK(chart.note ==
          "routing.ttl = 3; means of 3 replications, with 95 % intervals by Student's t");
    CHECK_THROWS_WITH_AS(conditions_of({"routing.ttl"}, {"ttl"}), doctest::Contains("KEY=VALUE"),
                         std::invalid_argument);
}

TEST_CASE("study chart: the error for an impossible request states what is possible") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), "a.count", {10}, "b.count", {1});
    using Error = std::invalid_argument;
    const auto ask = [&](const ChartQuestion& question) { study_chart(store, question); };
    CHECK_THROWS_WITH_AS(ask({.y = "reach"}), doctest::Contains("-x"), Error);
    CHECK_THROWS_WITH_AS(ask({.x = "count", .y = "reach"}), doctest::Contains("several"), Error);
    CHECK_THROWS_WITH_AS(ask({.x = "a.cont", .y = "reach"}),
                         doctest::Contains("did you mean \"a.count\"?"), Error);
    CHECK_THROWS_WITH_AS(ask({.x = "coutn", .y = "reach"}),
                         doctest::Contains("did you mean \"count\"?"), Error);
    CHECK_THROWS_WITH_AS(ask({.x = "a.count", .y = "recah"}),
                         doctest::Contains("did you mean \"reach\"?"), Error);
    CHECK_THROWS_WITH_AS(ask({.kind = ChartKind::heat_map, .x = "a.count", .y = "reach"}),
                         doctest::Contains("--by"), Error);
    CHECK_THROWS_WITH_AS(ask({.kind = ChartKind::cdf, .x = "a.count", .y = "reach"}),
                         doctest::Contains("-x"), Error);
}

TEST_CASE(
    "study chart: each row of a given CSV file is a mark beside the curve that the row names") {
    const TemporaryFolder folder;
    const Store store =
        made(folder.path("s.db"), "robot.r.count", {10, 20}, "routing.ttl", {1, 2, 3});
    const std::string file = folder.path("field.csv");
    const auto ask = [&](const std::string& text) {
        std::ofstream(file) << text;
        return study_chart(store,
                           {.x = "robots", .y = "latency_mean_s", .by = "ttl", .beside = file});
    };
    const Chart chart =
        ask("# measured\nttl,robots,latency_mean_s,latency_mean_s high\n2,10,0.5,0.75\n2,20,,\n");
    REQUIRE(chart.series.size() == 4);
    CHECK(chart.series[3].name == "2, field");
    CHECK(chart.series[3].beside == 1);
    REQUIRE(chart.series[3].points.size() == 1);
    CHECK(chart.series[3].points[0].x == 10);
    CHECK(chart.series[3].points[0].y == 0.5);
    CHECK(chart.series[3].points[0].high == 0.75);
    CHECK_FALSE(chart.series[3].points[0].low);
    CHECK_FALSE(chart.series[0].beside);

    const auto fails = [&](const std::string& text, const char* with) {
        CHECK_THROWS_WITH_AS(ask(text), doctest::Contains(with), InputError);
    };
    fails("ttl,robots,latency\n2,10,0.5\n", "no column \"latency_mean_s\"");
    fails("ttl,robots,latency_mean_s\n9,10,0.5\n", "field.csv:2:1: ttl: found \"9\"");
    fails("ttl,robots,latency_mean_s\n2,10 m,0.5\n", "found \"10 m\", expected a number");
    fails("ttl,robots,latency_mean_s\n2,10,0.5,\n", "found 4 fields; expected 3");
    fails("ttl,robots,latency_mean_s\n2,10\n", "found 2 fields; expected 3");
    fails("", "no line with the names of the columns");
}

TEST_CASE("study chart: a quotient of metrics is computed for each run separately") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), "robot.r.count", {10, 20}, "routing.ttl", {1, 2});
    const std::string quotient = "latency_mean_s/latency_mean_s";
    const Chart chart =
        study_chart(store, {.x = "robots", .y = quotient, .where = {{"routing.ttl", "2"}}});
    CHECK(chart.y_label == "latency_mean/latency_mean_s [s]");
    for (const ChartPoint& point : chart.series.at(0).points) CHECK(point.y == 1);
    // At ttl = 1 the first run's value is 0, and so its quotient has none.
    const Answers all = answers(store, {.metrics = {quotient}, .where = {{"routing.ttl", "1"}}});
    CHECK(all.list.at(0).gaps.undefined == 1);
    CHECK(all.list.at(0).values.size() == 2);
    CHECK_THROWS_WITH_AS(answers(store, {.metrics = {"latency_mean_s/latency"}}),
                         doctest::Contains("the metric \"latency\""), std::invalid_argument);
}

}  // namespace study_chart_test
