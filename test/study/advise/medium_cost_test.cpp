// SPDX-License-Identifier: MIT
#include "study/advise/medium_cost.hpp"

#include "experiment/build.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace medium_cost_test {
using namespace rovernet;

namespace {

const auto go_on = [] { return false; };

/// Robots that walk, two of which are switched off for a while; a message every 100 ms.
Scenario walkers(const std::string& more) {
    const test::TemporaryFolder folder;
    const std::string text = R"([scenario]
duration = "5 s"
[[robot]]
name = "A"
at = ["50 m", "50 m"]
off = ["2 s"]
on = ["3 s"]
[[robot]]
name = "r"
count = 30
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["300 m", "300 m"]] }
[[robot]]
name = "goer"
at = ["10 m", "10 m"]
off = ["1 s"]
on = ["4 s"]
move = { model = "goal", to = ["12 m", "10 m"] }
[routing]
ttl = 2
[[traffic]]
from = "A"
payload = "F"
every = "100 ms"
)";
    return ScenarioFile(folder.write("s.toml", text + more), {}).scenario();
}

}  // namespace

TEST_CASE(
    "costs of the medium: replayed frames reach about as many receivers as in the recorded run") {
    for (const char* more : {"[propagation]\nmodel = \"disc\"\nrange = \"90 m\"\n",
                             "[propagation]\nmodel = \"log_distance\"\nsigma = \"4 dB\"\n",
                             "[propagation]\nmodel = \"friis\"\n[access]\nmodel = \"csma\"\n",
                             "[propagation]\nmodel = \"friis\"\n[reception]\nmodel = \"sinr\"\n"}) {
        CAPTURE(more);
        const Scenario scenario = walkers(more);
        const MediumRecord record = record_medium(scenario, go_on);
        Network network(network_settings(scenario));
        populate(network, scenario);
        network.run_for(scenario.scenario.duration);
        CHECK(record.transmissions == network.metrics().transmissions);
        CHECK(record.frames >= record.transmissions);
        CHECK(record.receivers > 0);
        const MediumReplay replay(scenario);
        for (int again = 0; again < 2; ++again) {
            const auto answers = replay.answer(record, record.frames, 1e9);
            CHECK(answers.frames == record.frames);
            CHECK(answers.receivers >= record.receivers);  // those of frames that end later, too
            CHECK(answers.receivers <= record.receivers + 31);
        }
        CHECK(replay.answer(record, 5, 1e9).frames == 5);
    }
}

TEST_CASE(
    "costs of the medium: with a model of a longer range, the replayed frames have more "
    "receivers") {
    const Scenario near = walkers("[propagation]\nmodel = \"disc\"\nrange = \"50 m\"\n");
    const Scenario far = walkers("[propagation]\nmodel = \"disc\"\nrange = \"1 km\"\n");
    const MediumRecord record = record_medium(near, go_on);
    const auto few = MediumReplay(near).answer(record, record.frames, 1e9);
    const auto many = MediumReplay(far).answer(record, record.frames, 1e9);
    CHECK(few.frames == many.frames);
    CHECK(many.receivers > 3 * few.receivers);
    CHECK(few.receivers > 0);
}

TEST_CASE("costs of the medium: each model's median cost is between its lowest and highest cost") {
    const std::vector<Scenario> scenarios = {
        walkers("[propagation]\nmodel = \"disc\"\nrange = \"90 m\"\n"),
        walkers("[propagation]\nmodel = \"friis\"\n")};
    const MediumRecord record = record_medium(scenarios.back(), go_on);
    const auto costs = measure_medium(record, scenarios, {.turns = 3, .total_s = 0.01}, go_on);
    REQUIRE(costs.models.size() == 2);
    CHECK(costs.turns == 3);
    CHECK(costs.turn_s == 0.05);
    CHECK(costs.frames > 0);
    CHECK(costs.frames_per_transmission == 1);
    for (const MediumCost& cost : costs.models) {
        CHECK(cost.low_s > 0);
        CHECK(cost.low_s <= cost.median_s);
        CHECK(cost.median_s <= cost.high_s);
    }
}

TEST_CASE(
    "costs of the medium: without recorded frames, or if the measurement is stopped, no costs are "
    "given") {
    Scenario silent = walkers("");
    silent.traffic.clear();
    const MediumRecord none = record_medium(silent, go_on);
    CHECK(none.frames == 0);
    CHECK(measure_medium(none, {silent}, {}, go_on).models.empty());
    const Scenario talking = walkers("");
    const MediumRecord record = record_medium(talking, go_on);
    CHECK(measure_medium(record, {talking}, {}, [] { return true; }).models.empty());
}

}  // namespace medium_cost_test
