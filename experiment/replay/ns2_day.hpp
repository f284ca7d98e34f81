// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/recorded_day.hpp"

#include <optional>
#include <string>

namespace rovernet {

/// Routing of the messages when an ns-2 trace is simulated again. The routing protocol of the ns-2
/// run is not simulated.
enum class DayRouting {
    /// Flood: every robot forwards every message. A message for one robot is delivered only at that
    /// robot.
    flood,
    /// One hop: no robot forwards messages. A unicast is delivered if its destination receives the
    /// frame of the sender. A broadcast is delivered at all robots that receive this frame.
    direct,
};

struct Ns2DayOptions {
    DayRouting routing = DayRouting::flood;
    /// Path of a movement file that replaces the positions in the trace; none: the positions in the
    /// trace are used.
    std::optional<std::string> movements = {};
};

/// Reads a recorded run (movements and messages) from an ns-2 trace, in any format. Robots "n0",
/// "n1", ... move by Ns2Motion. They send the messages of the `s AGT` lines (sent by applications).
/// The run ends 1 s after the trace, so that the last messages can arrive.
///
/// The scenario of the run has the default radio of ns-2: 914 MHz, two_ray, 250 m, collisions with
/// a capture ratio of 10 dB, and the DCF of ns-2 at 1 Mb/s (its EIFS, its times, and a backoff
/// before every frame). RecordedDay::recorded() returns the outcome with the routing protocol of
/// the ns-2 run, which is for display, not for comparison.
///
/// Messages to the sender itself and to addresses of no robot are dropped, with a notice. Robots
/// are never switched off, since the trace does not record switching.
///
/// @throws InputError as read_ns2_trace(); if the trace has no robots; if it has no position of
///         some robots, which the message names (old traces have no position of a robot that never
///         moves)
RecordedDay read_ns2_day(const std::string& path, const Ns2DayOptions& options);

}  // namespace rovernet
