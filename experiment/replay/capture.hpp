// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Facts of a capture that was made of a recorded trace.
struct Capture {
    /// Packets in it.
    std::uint64_t packets = 0;
    /// Transmissions and receptions that are not in it: the begin of their frame, or their robot,
    /// is in a broken part of the trace.
    std::uint64_t left_out = 0;
    /// What is broken or missing in the trace.
    std::vector<std::string> damage;
};

/// Writes a recorded trace as pcapng: the capture of a wireless card in monitor mode on each robot.
///
/// Each robot is an interface with its name. A frame that it sends is there with the time at which
/// it begins; one that it receives with the time at which it ends there, and its level [dBm], which
/// is computed from the scenario inside. What a robot loses is not on its interface, nor is a
/// unicast for another robot.
/// @throws InputError if `in` is no recorded trace or has no scenario; RunError if `out` cannot be
/// written
Capture capture_recorded(const std::string& in, const std::string& out);

}  // namespace rovernet
