// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Summary of a packet capture (pcapng) made from a recorded trace.
struct Capture {
    /// Number of packets in the capture.
    std::uint64_t packets = 0;
    /// Number of transmissions and receptions that the capture lacks. Their frame starts or robot
    /// descriptions are in broken parts of the trace.
    std::uint64_t left_out = 0;
    /// Broken or missing parts of the trace, as sentences.
    std::vector<std::string> damage;
};

/// Writes a recorded trace as pcapng: the capture of a wireless card in monitor mode on each robot.
///
/// Each robot is an interface with the robot's name. A sent frame has the time of its start. A
/// received frame has the time of its end at the receiver, and its level [dBm], which is computed
/// from the scenario in the trace. Lost frames and unicasts for other robots are not captured.
/// @throws InputError if `in` is no recorded trace or has no scenario; RunError if `out` cannot be
/// written
Capture capture_recorded(const std::string& in, const std::string& out);

}  // namespace rovernet
