// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"

#include <string>
#include <vector>

namespace rovernet::cli {

/// Prints a notice on standard error about the lines of a trace that are no valid ns-2 lines.
/// @throws InputError if a file of ns-2 text has no valid line
void tell_refused(const std::string& file, const Ns2Counts& counts);
/// Prints notices on standard error about the broken or missing parts of a recorded trace.
/// @param damage  one sentence for each broken or missing part
void tell_damage(const std::string& file, const std::vector<std::string>& damage);

}  // namespace rovernet::cli
