// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>

// Time is a whole number of nanoseconds: sums are exact, and events are simultaneous on every
// machine or on none. Seconds as a double are only for formulas and input.

namespace rovernet {

/// Clock of the simulation: signed 64-bit nanoseconds since the start of the run (292 years).
/// SimClock has no now(); World::now is the current time.
struct SimClock {
    /// Member types that std::chrono requires of a clock.
    using rep = std::int64_t;
    using period = std::nano;
    using duration = std::chrono::duration<rep, period>;
    using time_point = std::chrono::time_point<SimClock>;
    static constexpr bool is_steady = true;
};

/// Length of time [ns], exact. Literals of std::chrono convert: 10ms.
using Duration = SimClock::duration;
/// Point in time [ns] since the start of the run, exact.
using Time = SimClock::time_point;

/// Start of a run: 0 s.
inline constexpr Time start_of_run{};
/// Time after every event, for events that do not happen.
inline constexpr Time never = Time::max();

/// Length of time in seconds [s], for formulas; exact to the nanosecond below 2^53 ns (104 days).
constexpr double seconds(Duration d) { return static_cast<double>(d.count()) / 1e9; }
/// Time since the start of the run [s]; exact below 2^53 ns.
constexpr double seconds(Time t) { return seconds(t.time_since_epoch()); }

/// Duration nearest to `s` seconds [s]; half nanoseconds are rounded away from zero.
/// @throws std::invalid_argument unless |s| <= 9.2e9 (292 years)
Duration from_seconds(double s);

}  // namespace rovernet
