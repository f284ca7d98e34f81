// SPDX-License-Identifier: MIT
#include "experiment/replay/run_comparison.hpp"

#include "experiment/replay/recorded_day.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace run_comparison_test {
using namespace rovernet;

namespace {

/// Records an example. @return path of its trace
std::string record(const test::TemporaryFolder& folder, const std::string& example,
                   const std::string& name) {
    ScenarioOptions options;
    options.set = {"trace.record=true"};
    RunOptions run;
    run.folder = folder.path(name);
    run_scenario(load_scenario(std::string(ROVERNET_EXAMPLES) + "/" + example, options), run);
    return folder.path(name + "/trace.mcap");
}

RunComparison compare(const std::string& a, const std::string& b, ComparisonChoice choice = {}) {
    return compare_runs({a, "one"}, {b, "other"}, choice);
}

}  // namespace

TEST_CASE(
    "run comparison: the numbers of gained and lost deliveries equal those of `rovernet replay "
    "--with`") {
    const test::TemporaryFolder folder;
    const std::string trace = record(folder, "rescue/rescue.toml", "run");
    const std::string other = folder.path("other.mcap");
    const std::vector<std::string> set = {"propagation.model=friis"};
    const RecordedDay day(trace);
    const PlayedDay played = day.record(other, set);
    const DeliveryChange table = change_of(day.recorded(), day.play(set), day.robots().size());
    CHECK(played.deliveries == day.play(set).deliveries);
    const RunComparison found = compare(trace, other, {.is_replay = true});
    CHECK(found.gained == table.all_gained());
    CHECK(found.gained == 53);
    CHECK(found.lost == table.all_lost());
    CHECK(found.same == day.recorded().deliveries.size());
    REQUIRE(found.changes.size() == 53);
    for (std::size_t i = 1; i < found.changes.size(); ++i)
        CHECK(found.changes[i - 1].time <= found.changes[i].time);
    // The path loss of free space, without walls: D and E hear the warning at once.
    CHECK(found.changes[0].is_gained);
    CHECK(found.changes[0].delivery == Delivery{NodeId{0}, 0, NodeId{3}, {}});
    CHECK(found.changes[0].time > found.changes[0].delivery.sent);
    CHECK_FALSE(found.changes[0].other);
    CHECK(found.first.field == "robots reachable");

    const RunComparison back = compare(other, trace, {.most_changes = 7});
    CHECK(back.lost == 53);
    CHECK(back.gained == 0);
    REQUIRE(back.changes.size() == 7);
    CHECK_FALSE(back.changes[0].is_gained);
    CHECK(back.changes[0].time == found.changes[0].time);
}

TEST_CASE("run comparison: a run does not differ from itself") {
    const test::TemporaryFolder folder;
    const std::string trace = record(folder, "rescue/rescue.toml", "run");
    const RunComparison found = compare(trace, trace);
    CHECK(found.gained + found.lost == 0);
    CHECK(found.same == 31);
    CHECK(found.changes.empty());
    CHECK(found.first.is_equal);
}

TEST_CASE(
    "run comparison: a delivery missing in run B has the outcome of the message's last frame in "
    "run B") {
    const test::TemporaryFolder folder;
    const std::string trace = record(folder, "relay/routes.toml", "run");
    const std::string other = folder.path("other.mcap");
    RecordedDay(trace).record(other, {"access.model=none"});
    const RunComparison found = compare(trace, other);
    REQUIRE(found.lost > 0);
    std::size_t collided = 0;
    for (const ChangedDelivery& change : found.changes)
        if (change.other == Fate::collided) ++collided;
    CHECK(collided > 0);
    CHECK(collided < found.lost);
}

TEST_CASE("run comparison: traces of runs with different robots are refused") {
    const test::TemporaryFolder folder;
    const std::string rescue = record(folder, "rescue/rescue.toml", "rescue");
    const std::string patrol = record(folder, "patrol/patrol.toml", "patrol");
    CHECK_THROWS_WITH_AS(compare(rescue, patrol),
                         "other: found 9 robots, but 5 robots in one; two runs are compared robot "
                         "by robot: expected the same robots in the same order",
                         InputError);
}

}  // namespace run_comparison_test
