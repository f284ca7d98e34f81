// SPDX-License-Identifier: MIT
// Whether averages over points compare like with like, where runs failed, are missing or have no
// value.
#include "study/results.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

namespace balance_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

/// How one run ends.
enum class Ending { finished, fails, undefined, missing };

constexpr int replications = 4;
const std::vector<int> ttls = {1, 3, 8};
const std::vector<int> periods = {1, 2};

/// Delivery rises with the TTL and is worse where messages are frequent.
double delivery(int ttl, int period, int r) { return 0.05 * ttl + 0.2 * period + 0.01 * r; }

Store made(const std::string& path, const std::function<Ending(int ttl, int period, int r)>& fate) {
    Store store = Store::open_to_write(path);
    std::vector<StoredPoint> points;
    for (const int ttl : ttls) {
        for (const int period : periods) {
            Table settings;
            settings.set("routing.ttl", ttl);
            settings.set("traffic.0.every", period);
            const auto number = static_cast<std::uint32_t>(points.size());
            points.push_back({number, std::to_string(number), settings});
        }
    }
    store.set_points(points);
    store.set_property("study", R"({"replications":4,"metrics":["reach"]})");
    for (const StoredPoint& point : points) {
        const int ttl = ttls[point.number / 2], period = periods[point.number % 2];
        for (int r = 0; r < replications; ++r) {
            const Ending what = fate(ttl, period, r);
            if (what == Ending::missing) continue;
            StoredRun run{};
            run.id = point.id + "/" + std::to_string(r);
            run.point = point.number;
            run.replication = static_cast<std::uint32_t>(r);
            if (what == Ending::fails) run.error = "the event limit";
            if (what == Ending::finished) {
                run.measurement.metrics = {{"reach", delivery(ttl, period, r)}};
            }
            if (what == Ending::undefined) run.measurement.metrics = {{"reach", std::nullopt}};
            store.record(run);
        }
    }
    return store;
}

const std::vector<std::string> by_ttl = {"routing.ttl"};

/// Large TTLs fail where messages are rare, where delivery is good: what is left makes them worse.
Ending biased(int ttl, int period, int r) {
    if (ttl == 8 && period == 2) return Ending::fails;
    return ttl == 3 && period == 2 && r > 0 ? Ending::fails : Ending::finished;
}

std::string refusal(const Store& store, const Question& question) {
    try {
        answers(store, question);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

constexpr double rounding = 1e-12;  // of a mean of a few numbers below 1

}  // namespace

TEST_CASE(
    "balance: if rows of results lack different runs, no means are given; the error lists these "
    "runs") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), biased);
    const std::string text = refusal(store, {.group_by = by_ttl});
    CAPTURE(text);
    CHECK(text.starts_with("reach cannot be averaged over traffic.0.every"));
    CHECK(has(
        text,
        "\n  routing.ttl=3 has no value in 3 of 8 cells (failed runs: 3 at traffic.0.every=2)\n"));
    CHECK(has(
        text,
        "\n  routing.ttl=8 has no value in 4 of 8 cells (failed runs: 4 at traffic.0.every=2)\n"));
    CHECK_FALSE(has(text, "routing.ttl=1 "));
    CHECK(has(text, "--where KEY=VALUE"));
    CHECK(has(text, "--common to average only the 4 of 8 cells"));
}

TEST_CASE(
    "balance: means over the runs that all rows have are right, even if plain means mislead "
    "because of failed runs") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), biased);
    const Answers all = answers(store, {.group_by = by_ttl, .common = true});
    REQUIRE(all.list.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::abs(*all.list[i].value - (0.05 * ttls[i] + 0.2 + 0.015)) < rounding);
        CHECK(all.list[i].values.size() == 4);
        CHECK(all.list[i].cells == 8);
        CHECK(all.list[i].left_out == 4);
    }
    CHECK(all.averaged == std::vector<std::string>{"traffic.0.every"});
    CHECK(all.list[1].gaps.failed == 3);
    CHECK(all.list[2].gaps.failed == 4);
    CHECK(coverage_text(all) ==
          "averaged over traffic.0.every; the mean of reach leaves out 4 of 8 cells, because some "
          "rows have no value in these cells (a cell is one replication at one value of each key "
          "that is averaged over); "
          "7 runs failed");
    // Held at one value, nothing is averaged over, and each row has its own n.
    const Answers held = answers(store, {.group_by = by_ttl, .where = {{"traffic.0.every", "2"}}});
    CHECK(held.averaged.empty());
    CHECK(held.list[0].values.size() == 4);
    CHECK(held.list[1].values.size() == 1);
    CHECK(held.list[2].values.empty());
    CHECK(coverage_text(held) == "7 runs failed");
}

TEST_CASE(
    "balance: a run without a value, and a run that was not made, count as missing runs of a row") {
    const TemporaryFolder folder;
    for (const Ending fate : {Ending::undefined, Ending::missing}) {
        const std::string name = fate == Ending::undefined ? "undefined" : "missing";
        CAPTURE(name);
        const Store store = made(folder.path(name + ".db"), [&](int ttl, int period, int r) {
            return ttl == 3 && period == 1 && r == 2 ? fate : Ending::finished;
        });
        const std::string text = refusal(store, {.group_by = by_ttl});
        const std::string runs =
            fate == Ending::undefined ? "runs without a value" : "missing runs";
        CHECK(has(text, "routing.ttl=3 has no value in 1 of 8 cells (" + runs +
                            ": 1 at traffic.0.every=1)"));
        CHECK(answers(store, {.group_by = by_ttl, .common = true}).list[0].left_out == 1);
    }
}

TEST_CASE("balance: even a single row of results is not averaged if runs are missing") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), biased);
    CHECK(has(refusal(store, {.group_by = by_ttl, .where = {{"routing.ttl", "8"}}}),
              "has no value in 4 of 8 cells"));
}

TEST_CASE(
    "balance: if the same replications are missing in all rows, the rows are averaged, and this is "
    "reported") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), [](int, int, int r) {
        return r == 3 ? Ending::missing : Ending::finished;
    });
    const Answers all = answers(store, {.group_by = by_ttl});
    CHECK(all.list[0].values.size() == 3);
    CHECK(all.list[0].gaps.missing == 2);
    CHECK(all.runs.missing == 6);
    CHECK(incompleteness(all.runs) == "unfinished: 6 of 24 runs are missing");
    CHECK(coverage_text(all) == "averaged over traffic.0.every; unfinished: 6 runs are missing");
}

TEST_CASE("balance: a key that has only one value in each row is reported as not averaged over") {
    const TemporaryFolder folder;
    Store store = Store::open_to_write(folder.path("s.db"));
    std::vector<StoredPoint> points;
    for (std::uint32_t i = 0; i < 2; ++i) {
        Table settings;
        settings.set("routing.ttl", static_cast<int>(i));
        settings.set("radio.power", static_cast<int>(10 * i));
        points.push_back({i, std::to_string(i), settings});
    }
    store.set_points(points);
    const Answers all = answers(store, {.metrics = {"reach"}, .group_by = by_ttl});
    CHECK(all.averaged.empty());
    CHECK(all.along == std::vector<std::string>{"radio.power"});
    CHECK(has(coverage_text(all),
              "not averaged over radio.power (each row has only one value of such a key)"));
}

TEST_CASE(
    "balance: if a combination of values is not in the study, the runs of this combination count "
    "as missing") {
    const TemporaryFolder folder;
    const Store store = made(folder.path("s.db"), [](int, int, int) { return Ending::finished; });
    std::vector<StoredPoint> points = store.points();
    points.erase(points.begin() + 5);
    const Rows rows = rows_of(points, by_ttl);
    const Inventory inventory = inventory_of(store);
    const Cells cells(rows, inventory, values_of_points(store, "reach"));
    CHECK(cells.unbalanced() ==
          "  routing.ttl=8 has no value in 4 of 8 cells (runs that are not in the study: 4 at "
          "traffic.0.every=2)");
}

}  // namespace balance_test
