// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/ns2_day.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Writes an ns-2 trace as a recorded trace, for all that reads recorded traces: the movements of
/// read_ns2_day(), and the records of read_ns2_trace(). The scenario is that of read_ns2_day(), an
/// open field with ns-2's default radio.
///
/// A frame lasts from the line in which its sender passes it on (`s RTR`, `f RTR`) to its first
/// reception, time in the queue included. A frame that nobody received has no length.
///
/// @param to  path of the recorded trace
/// @return sentences about what an ns-2 trace does not tell
/// @throws InputError as read_ns2_day()
std::vector<std::string> record_ns2_trace(const std::string& path, const std::string& to,
                                          const Ns2DayOptions& options);

}  // namespace rovernet
