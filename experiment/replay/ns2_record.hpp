// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/ns2_day.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Converts an ns-2 trace to a recorded trace. The movements and the scenario are the results of
/// read_ns2_day(): an open field, with ns-2's default radio. The records are the results of
/// read_ns2_trace().
///
/// A frame starts at the line in which its sender's router sends or forwards it (`s RTR`, `f RTR`),
/// and ends at its first reception. Its length therefore includes the time in the sender's queue. A
/// frame that nobody received has no length.
///
/// @param to  path of the recorded trace
/// @return notices, as sentences, about data that the ns-2 trace lacks
/// @throws InputError as read_ns2_day()
std::vector<std::string> record_ns2_trace(const std::string& path, const std::string& to,
                                          const Ns2DayOptions& options);

}  // namespace rovernet
