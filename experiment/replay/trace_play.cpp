// SPDX-License-Identifier: MIT
#include "experiment/replay/trace_play.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

using WallClock = std::chrono::steady_clock;

Time time_of(const Ns2Line& line) {
    return std::visit(
        [](const auto& event) {
            if constexpr (requires { event.time; }) return event.time;
            return start_of_run;
        },
        line);
}

/// Waits until `wall_s` after `begun`. @return false if the play is stopped
bool wait_until(double wall_s, WallClock::time_point begun, const TracePlay& play) {
    constexpr double longest_wait_s = 0.05;
    for (;;) {
        const std::chrono::duration<double> passed = WallClock::now() - begun;
        const double left_s = wall_s - passed.count();
        if (!(left_s > 0)) return true;
        if (!play.goes_on()) return false;
        std::this_thread::sleep_for(
            std::chrono::duration<double>(std::min(left_s, longest_wait_s)));
    }
}

}  // namespace

bool play_trace(Ns2Source source, double speed, const TracePlay& play) {
    Ns2File file(std::move(source));
    const auto begun = WallClock::now();
    std::optional<Time> first;
    while (const Ns2Line* line = file.next()) {
        const Time time = time_of(*line);
        if (!first) first = time;
        if (!wait_until(seconds(time - *first) / speed, begun, play)) return false;
        if (!play.goes_on()) return false;
        play.show(file.text());
    }
    file.expect_trace();
    return true;
}

}  // namespace rovernet
