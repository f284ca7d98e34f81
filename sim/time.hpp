// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>

namespace rovernet {

/// The simulation's clock: signed 64-bit nanoseconds since the start of the run (292 years).
struct SimClock {
    using rep = std::int64_t;
    using period = std::nano;
    using duration = std::chrono::duration<rep, period>;
    using time_point = std::chrono::time_point<SimClock>;
    static constexpr bool is_steady = true;
};

using Duration = SimClock::duration;  ///< [ns], exact
using Time = SimClock::time_point;    ///< [ns] since the start of the run, exact

inline constexpr Time start_of_run{};
inline constexpr Time never = Time::max();

/// `d` in seconds [s], for formulas; exact below 2^53 ns (104 days).
constexpr double seconds(Duration d) { return static_cast<double>(d.count()) / 1e9; }
constexpr double seconds(Time t) { return seconds(t.time_since_epoch()); }

/// The duration nearest to `s` seconds [s].
/// @throws std::invalid_argument unless |s| <= 9.2e9 (292 years)
Duration from_seconds(double s);

}  // namespace rovernet
