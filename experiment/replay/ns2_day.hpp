// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/recorded_day.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Way of the messages of an ns-2 trace, whose own protocol is not simulated.
enum class DayRouting {
    /// To everyone, who forwards them; one for a single robot is delivered there alone.
    flood,
    /// To their destination, or to everyone who hears the sender, over one hop.
    direct,
};

struct Ns2DayOptions {
    DayRouting routing = DayRouting::flood;
    /// Movement file that moved the robots, in place of what the trace tells of their places.
    std::optional<std::string> movements = {};
};

/// Reads a day from an ns-2 trace, in any format: robots "n0", "n1", ... move by Ns2Motion and say
/// what the `s AGT` lines say. The day lasts a second longer than the trace, so that what was said
/// last can arrive.
///
/// The scenario of the day has the radio that ns-2 has by default: 914 MHz, two_ray, 250 m,
/// collisions with a capture ratio of 10 dB, and the DCF of 802.11 at 1 Mb/s. `recorded()` is what
/// the trace tells, of its own protocol: to be shown, not to be compared with.
///
/// Left out, with a notice: messages to the sender itself, and to addresses that are no robot's.
/// The trace does not tell when robots are switched off.
///
/// @throws InputError as read_ns2_trace(); if it has no robots; naming the robots of which it does
///         not tell where they are (old traces hold no place of one that never moves)
RecordedDay read_ns2_day(const std::string& path, const Ns2DayOptions& options);

}  // namespace rovernet
