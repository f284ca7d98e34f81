// SPDX-License-Identifier: MIT
#include "study/results.hpp"

#include "study/results_csv.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace results_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

/// Two models x two powers, three replications: the value is 100 model + 10 power + replication.
Store made(const std::string& path) {
    Store store = Store::open_to_write(path);
    std::vector<StoredPoint> points;
    for (std::uint32_t i = 0; i < 4; ++i) {
        Table settings;
        settings.set("propagation.model", i < 2 ? "disc" : "friis, \"free\"");
        settings.set("radio.power", static_cast<int>(i % 2));
        points.push_back({i, std::to_string(i), settings});
    }
    store.set_points(points);
    store.set_property("study", R"({"confidence":0.9,"metrics":["reach"]})");
    for (std::uint32_t i = 0; i < 4; ++i) {
        for (std::uint32_t r = 0; r < 3; ++r) {
            StoredRun run{};
            run.id = std::to_string(10 * i + r);
            run.point = i;
            run.replication = r;
            const double value = 100.0 * (i / 2) + 10 * (i % 2) + r;
            run.measurement.metrics = {{"reach", value}, {"hops_mean", std::nullopt}};
            run.measurement.fingerprint = "f";
            store.record(run);
        }
    }
    return store;
}

constexpr double rounding = 1e-9;  // of sums of a few numbers below 1e3

}  // namespace

TEST_CASE("results: by default each point of a study has a row with mean and interval") {
    const TemporaryFolder folder;
    const auto list = answers(made(folder.path("s.db")), {}).list;
    REQUIRE(list.size() == 4);
    CHECK(list[2].metric == "reach");
    CHECK(list[2].values.size() == 3);
    CHECK(std::abs(*list[2].value - 101) < rounding);
    // t of 2 degrees at 90 % is 2.919985580; the standard deviation of 100, 101, 102 is 1
    const double half = 2.919985580353726 / std::sqrt(3.0);
    CHECK(std::abs(*list[2].high - (101 + half)) < rounding);
    CHECK(std::abs(*list[2].low - (101 - half)) < rounding);
}

TEST_CASE(
    "results: if no point has the given value, the error lists the existing values in the study's "
    "order") {
    const TemporaryFolder folder;
    Store store = Store::open_to_write(folder.path("s.db"));
    std::vector<StoredPoint> points;
    for (const char* robots : {"2", "10", "100", "30"}) {
        for (const char* speed : {"9 m/s", "10 m/s"}) {
            Table settings;
            settings.set("robot.r.count", std::string(robots));
            settings.set("speed", std::string(speed));
            const auto number = static_cast<std::uint32_t>(points.size());
            points.push_back({number, std::to_string(number), settings});
        }
    }
    store.set_points(points);
    CHECK_THROWS_WITH_AS(
        points_where(store, {{"robot.r.count", "3"}}),
        "no run of this study has robot.r.count = 3; the values in this study are 2, 10, 100, 30",
        std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        points_where(store, {{"robot.r.count", "2"}, {"speed", "1"}}),
        "no run of this study has speed = 1; the values in this study are 9 m/s, 10 m/s",
        std::invalid_argument);
}

TEST_CASE(
    "results: intervals of a ratio are by STaR-Bets and end at 1; on request they are by Student's "
    "t") {
    const TemporaryFolder folder;
    Store store = Store::open_to_write(folder.path("s.db"));
    store.set_points({{0, "p", {}}});
    for (std::uint32_t r = 0; r < 30; ++r) {
        StoredRun run{};
        run.id = std::to_string(r);
        run.replication = r;
        run.measurement.metrics = {{"delivery_ratio", 1.0}, {"latency_mean_s", 0.1 + 0.01 * r}};
        store.record(run);
    }
    const std::vector<std::string> metrics = {"delivery_ratio", "latency_mean_s"};
    const auto list = answers(store, {.metrics = metrics}).list;
    CHECK(list[0].method == IntervalMethod::star);
    CHECK(*list[0].low < 0.9);
    CHECK(*list[0].high == 1);
    CHECK(list[1].method == IntervalMethod::t);
    const auto by_t = answers(store, {.metrics = metrics, .interval = IntervalMethod::t}).list;
    CHECK_FALSE(by_t[0].low);
    store.set_property("study", R"({"interval":"t"})");
    CHECK_FALSE(answers(store, {.metrics = metrics}).list[0].low);
}

TEST_CASE("results: a row has one value per replication, which is the mean over the row's points") {
    const TemporaryFolder folder;
    const auto list = answers(made(folder.path("s.db")),
                              {.group_by = std::vector<std::string>{"propagation.model"}})
                          .list;
    REQUIRE(list.size() == 2);
    CHECK(list[0].settings.entries.size() == 1);
    CHECK(list[0].values == std::map<std::uint32_t, double>{{0, 5}, {1, 6}, {2, 7}});
    CHECK(list[0].summary->n == 3);
    CHECK(list[1].values.at(2) == 107);
}

TEST_CASE("results: conditions select points, and a condition that no point meets is an error") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"));
    const auto list =
        answers(store, {.where = {{"propagation.model", "disc"}, {"radio.power", "1"}}}).list;
    REQUIRE(list.size() == 1);
    CHECK(list[0].values.at(0) == 10);
    CHECK_THROWS_WITH_AS(answers(store, {.where = {{"radio.power", "2"}}}),
                         doctest::Contains("the values in this study are 0, 1"),
                         std::invalid_argument);
    CHECK_THROWS_AS(answers(store, {.where = {{"radio.pwr", "1"}}}), std::invalid_argument);
}

TEST_CASE(
    "results: a metric without a value in any run has no mean, and runs without a value are "
    "counted") {
    const TemporaryFolder folder;
    const auto list = answers(made(folder.path("s.db")), {.metrics = {"hops_mean"}}).list;
    CHECK(list[0].gaps.undefined == 3);
    CHECK_FALSE(list[0].value);
    CHECK_FALSE(list[0].summary);
}

TEST_CASE("results: if a quantile is requested, it replaces the mean") {
    const TemporaryFolder folder;
    const auto list = answers(made(folder.path("s.db")), {.quantile = 0.5}).list;
    CHECK(*list[0].value == 1);
    CHECK_FALSE(list[0].low);  // three values are too few for an interval
}

TEST_CASE("results: an unknown metric or key is an error with a suggestion") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"));
    CHECK_THROWS_WITH_AS(answers(store, {.metrics = {"reech"}}),
                         doctest::Contains("did you mean \"reach\"?"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(answers(store, {.metrics = {"delivry"}}),
                         doctest::Contains("did you mean \"deliveries\", \"delivery_ratio\", "),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(answers(store, {.metrics = {"xyz"}}),
                         doctest::Contains("--sql 'SELECT name FROM metric_name' lists"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(answers(store, {.group_by = std::vector<std::string>{"radio.powr"}}),
                         doctest::Contains("did you mean \"radio.power\"?"), std::invalid_argument);
}

TEST_CASE("results: CSV has a header, a row per run and metric, and quotes where needed") {
    const TemporaryFolder folder;
    std::string text;
    write_csv(made(folder.path("s.db")), {}, [&](std::string_view piece) { text += piece; });
    CHECK(
        text.starts_with("point,propagation.model,radio.power,replication,metric,value\n"
                         "0,disc,0,0,hops_mean,\n0,disc,0,0,reach,0\n"));
    CHECK(text.ends_with("3,\"friis, \"\"free\"\"\",1,2,reach,112\n"));
    CHECK(std::count(text.begin(), text.end(), '\n') == 25);
}

TEST_CASE("results: CSV has only the requested conditions and metrics, grouped as requested") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"));
    const auto csv = [&](const Question& question) {
        std::string text;
        write_csv(store, question, [&](std::string_view piece) { text += piece; });
        return text;
    };
    CHECK(csv({.metrics = {"reach"}, .where = {{"radio.power", "1"}}}) ==
          "point,propagation.model,radio.power,replication,metric,value\n"
          "1,disc,1,0,reach,10\n1,disc,1,1,reach,11\n1,disc,1,2,reach,12\n"
          "3,\"friis, \"\"free\"\"\",1,0,reach,110\n3,\"friis, \"\"free\"\"\",1,1,reach,111\n"
          "3,\"friis, \"\"free\"\"\",1,2,reach,112\n");
    CHECK(csv({.group_by = std::vector<std::string>{"radio.power"}}) ==
          "radio.power,replication,metric,value\n"
          "0,0,reach,50\n0,1,reach,51\n0,2,reach,52\n1,0,reach,60\n1,1,reach,61\n1,2,reach,62\n");
    std::string text;
    write_provenance_csv(store, {{"propagation.model", "disc"}},
                         [&](std::string_view piece) { text += piece; });
    CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 6);
    CHECK_THROWS_AS(csv({.metrics = {"reech"}}), std::invalid_argument);
}

}  // namespace results_test
