// SPDX-License-Identifier: MIT
// steps ROBOTS: time of a step of 100 ms in which each of so many robots gets a new velocity, in
// C++: what bench/python_step compares Python with. Prints the least of ten rounds in microseconds.
#include "live/lockstep/stepped_run.hpp"
#include "scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>
#include <vector>

using namespace rovernet;

namespace {

/// The scenario of bench/python_step: robots 10 m apart in an open field that say nothing.
Scenario still(int robots) {
    Array list;
    for (int i = 0; i < robots; ++i) {
        Table robot;
        robot.set("name", fmt::format("r{}", i));
        robot.set("at", Array{fmt::format("{} m", 10 * i), "0 m"});
        list.emplace_back(std::move(robot));
    }
    Table times, document;
    times.set("duration", "1e6 s");
    document.set("scenario", std::move(times));
    document.set("robot", std::move(list));
    return load_scenario(ScenarioFile(document, "", {}));
}

}  // namespace

int main(int argc, char** argv) {
    constexpr int steps = 20'000, rounds = 10;
    const int robots = argc > 1 ? std::atoi(argv[1]) : 10;
    SteppedRun run(still(robots), {});
    const std::vector<double> velocities(2 * static_cast<std::size_t>(robots), 0.5);
    double least = 1e9;
    for (int round = 0; round < rounds; ++round) {
        run.reset();
        const auto begun = std::chrono::steady_clock::now();
        for (int i = 0; i < steps; ++i) {
            run.drive(velocities);
            run.step(256, [] { return true; });
            run.heard();
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
        least = std::min(least, took.count());
    }
    fmt::print("{:.3f}\n", 1e6 * least / steps);
}
