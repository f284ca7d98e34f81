// SPDX-License-Identifier: MIT
// A run that is taken step by step by a program in this process.
#include "live/lockstep/stepped_run.hpp"

#include "live/input_replay.hpp"
#include "test/live/talk.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace stepped_run_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
using Json = nlohmann::json;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool step(SteppedRun& run) {
    return run.step(256, [] { return true; });
}

/// Fingerprint of 15 steps of 100 ms with the commands of by_lines(), robots and messages out of
/// order.
std::string by_steps(const Scenario& scenario, std::optional<std::uint64_t> seed,
                     std::optional<std::string> folder = {}) {
    SteppedRun run(scenario, {.folder = std::move(folder)});
    run.reset(seed);
    for (int n = 1; n <= 15; ++n) {
        if (n % 3 == 0) {
            run.command(2, SendCommand{.port = 9, .payload = "c"});
            run.command(0, SendCommand{.to = NodeId{1}, .payload = "a"});
        }
        run.drive(std::vector<double>{0.1 * n, 0.3, nan, nan, -1, 0});
        if (n == 5) run.command(1, GoalCommand{{100, 10, 0}, {2}});
        if (n == 8) run.command(1, PlaceCommand{{120, 5, 1.5}, {-0.75}});
        if (n == 9) run.command(1, GoalCommand{{120, 5, 0}, {1}});
        step(run);
        run.heard();
    }
    return run.finish().fingerprint;
}

std::string by_lines(const Scenario& scenario, std::optional<std::uint64_t> seed) {
    Talk talk(scenario);
    talk.say(0, R"({"type":"hello","protocol":1,"robots":["A","B","C"],"step":"100 ms"})");
    if (seed) talk.say(0, Json{{"type", "reset"}, {"seed", *seed}}.dump());
    for (int n = 1; n <= 15; ++n) {
        Json line{{"type", "step"}, {"n", n}};
        if (n % 3 == 0) {
            line["send"] = Json::parse(
                R"([{"from":"C","port":9,"data":"Yw=="},{"from":"A","to":"B","data":"YQ=="}])");
        }
        line["do"]["A"] = Json{{"v", 0.1 * n}, {"w", 0.3}};
        line["do"]["C"] = Json{{"v", -1}};
        if (n == 5) line["do"]["B"] = Json{{"goal", {100, 10}}, {"speed", 2}};
        if (n == 8) line["do"]["B"] = Json{{"place", {120, 5, 1.5}}, {"heading", -0.75}};
        if (n == 9) line["do"]["B"] = Json{{"goal", {120, 5, 0}}};
        talk.say(0, line.dump());
    }
    talk.say(0, R"({"type":"bye"})");
    return talk.fingerprint->text();
}

template <class Act>
std::string refusal(Act act) {
    try {
        act();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE(
    "stepped run: commands give the same run as the same commands over the lock-step protocol") {
    const Scenario scenario = three_in_a_row();
    for (const auto seed : {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(7)}) {
        CHECK(by_steps(scenario, seed) == by_lines(scenario, seed));
    }
    CHECK(by_steps(scenario, 7) != by_steps(scenario, 8));  // delays before forwarding
}

TEST_CASE("stepped run: replay of the input log reproduces the run") {
    const TemporaryFolder folder;
    const std::string fingerprint = by_steps(three_in_a_row(), 7, folder.path("run"));
    const InputReplay replay = replay_inputs(folder.path("run"), {});
    CHECK(replay.recorded == fingerprint);
    CHECK(replay.now == fingerprint);
    CHECK(replay.inputs == 15 * 2 + 5 * 2 + 3 + 3);  // drives, messages, goals and a place, stops
    CHECK_FALSE(replay.is_other_scenario);
}

TEST_CASE(
    "stepped run: an interrupted step can be continued, and the input log reproduces the run") {
    const TemporaryFolder folder;
    SteppedRun run(three_in_a_row(), {.step = 1s, .folder = folder.path("run")});
    run.command(0, SendCommand{.payload = "a"});
    CHECK_FALSE(run.step(1, [] { return false; }));
    CHECK(run.session().network().now() < start_of_run + 1s);
    run.command(1, SendCommand{.payload = "b"});
    CHECK(step(run));
    run.command(2, DriveCommand{{1}, {0}});
    CHECK_FALSE(run.step(1, [] { return false; }));
    const std::string fingerprint = run.finish().fingerprint;
    CHECK(replay_inputs(folder.path("run"), {}).now == fingerprint);
}

TEST_CASE(
    "stepped run: the array of poses has a row per robot, follows the driven arc, and keeps its "
    "memory address") {
    SteppedRun run(three_in_a_row(), {.robots = std::vector<std::string>{"C", "A"}});
    const double* pose = run.poses().data();
    CHECK(pose[0] == 300);
    CHECK(pose[3] == 0);
    run.drive(std::vector<double>{1, 0, 0.5, 0.2});
    for (int i = 0; i < 10; ++i) step(run);
    CHECK(run.poses().data() == pose);
    constexpr double rounding = 1e-9;  // [m] of nanoseconds at 1 m/s
    constexpr double chord = 1e-3;     // [m] that a chord is beside its arc at most
    CHECK(std::abs(pose[0] - 301) < rounding);
    CHECK(std::abs(pose[3] - 0.5 / 0.2 * std::sin(0.2)) < chord);
    CHECK(std::abs(pose[4] - 0.5 / 0.2 * (1 - std::cos(0.2))) < chord);
    CHECK(std::abs(pose[5] - 0.2) < rounding);
    run.reset();
    CHECK(run.poses().data() == pose);
    CHECK(pose[0] == 300);
}

TEST_CASE("stepped run: received messages have time, sender, level and port") {
    SteppedRun run(three_in_a_row(), {});
    run.command(0, SendCommand{.port = 7, .payload = "F"});
    step(run);
    const auto heard = run.heard();
    REQUIRE(heard.size() == 2);
    CHECK(std::tuple(heard[0].at, heard[0].from, heard[0].last_hop, heard[0].hops) ==
          std::tuple(NodeId{1}, NodeId{0}, NodeId{0}, 1));
    CHECK(std::tuple(heard[1].at, heard[1].from, heard[1].last_hop, heard[1].hops) ==
          std::tuple(NodeId{2}, NodeId{0}, NodeId{1}, 2));
    CHECK(heard[1].port == 7);
    CHECK(heard[1].payload == "F");
    CHECK(run.heard().empty());
}

TEST_CASE("stepped run: a run ends at the end of the scenario, and can then be reset") {
    SteppedRun run(three_in_a_row(), {.step = 1500ms});
    CHECK(step(run));
    CHECK_FALSE(run.is_done());
    CHECK(step(run));  // the rest of 500 ms
    CHECK(run.is_done());
    CHECK(run.session().network().now() == start_of_run + 2s);
    CHECK(refusal([&] { step(run); }) == "the run is at its end; expected reset() or finish()");
    CHECK(run.finish().simulated == 2s);
    CHECK(run.is_over());
    CHECK(refusal([&] { step(run); }) == "the run is over; expected reset() first");
    CHECK(refusal([&] { run.finish(); }) == "the run is over; expected reset() first");
    run.reset(3);
    CHECK(run.scenario().scenario.seed == 3);
    CHECK(step(run));
}

TEST_CASE("stepped run: numbers out of range are refused without effect") {
    SteppedRun run(three_in_a_row(), {});
    const auto driven = [&](double v, double w) {
        return refusal([&] { run.drive(std::vector<double>{1, 1, v, w, 1, 1}); });
    };
    CHECK(driven(1001, 0) == "speed of robot B must be from -1000 to 1000 m/s, got 1001");
    CHECK(driven(nan, 0) == "speed of robot B must be from -1000 to 1000 m/s, got nan");
    CHECK(driven(0, -1e300) ==
          "turn rate of robot B must be from -1000 to 1000 rad/s, got -1e+300");
    CHECK(refusal([&] {
              run.drive(std::vector<double>{1, 1});
          }) == "expected an array of velocities with the shape (3, 2)");
    CHECK(refusal([&] { run.drive(std::vector<double>(6, 0.0), Duration{0}); }) ==
          "timeout of robot A must be > 0 s");
    CHECK(refusal([&] {
              run.command(2, GoalCommand{{2e9, 0, 0}, {1}});
          }) == "goal of robot C must be from -1e9 to 1e9 m, got 2000000000");
    CHECK(refusal([&] {
              run.command(2, GoalCommand{{1, 0, 0}, {0}});
          }) == "speed of robot C must be above 0 and up to 1000 m/s, got 0");
    CHECK(refusal([&] { run.command(0, SendCommand{.payload = std::string(65'536, 'x')}); }) ==
          "a message of robot A has 65536 bytes; expected 65507 at most");
    step(run);
    CHECK(run.poses()[0] == 0);
    CHECK(refusal([] { SteppedRun(three_in_a_row(), {.step = 999ns}); }) ==
          "a step must be 1 us or more, got 9.99e-07 s");
    CHECK(refusal([] {
              SteppedRun(three_in_a_row(), {.robots = std::vector<std::string>{"A", "A"}});
          }) == "robot A is listed twice");
}

TEST_CASE("stepped run: commands that a callback gives during a step act in the next step") {
    struct Echo {
        SteppedRun** run;
        KindMask kinds() const { return kind_of<Sent>(); }
        void on(const Record& record, const RecordContext& context) {
            const auto& sent = std::get<Sent>(record);
            if (context.messages[sent.message].payload != "a") return;
            (*run)->command(2, SendCommand{.payload = "b"});
            (*run)->command(2, DriveCommand{{1}, {0}});
        }
    };
    SteppedRun* self = nullptr;
    SteppedRun run(three_in_a_row(),
                   {.prepare = [&](Network& network) { network.add_sink(Echo{&self}); }});
    self = &run;
    for (int i = 0; i < 20; ++i) run.command(0, SendCommand{.payload = "a"});
    step(run);
    CHECK(run.session().network().metrics().messages == 20);
    CHECK(run.poses()[6] == 300);
    step(run);
    CHECK(run.session().network().metrics().messages == 40);
    CHECK(run.poses()[6] == doctest::Approx(300.1));
}

}  // namespace stepped_run_test
