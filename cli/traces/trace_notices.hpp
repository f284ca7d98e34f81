// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"

#include <string>
#include <vector>

namespace rovernet::cli {

/// Prints on standard error which lines of a trace are no valid ns-2 lines, if any.
/// @throws InputError if a file of ns-2 text has no valid line
void tell_refused(const std::string& file, const Ns2Counts& counts);
/// Prints on standard error the broken or missing parts of a recorded trace.
void tell_damage(const std::string& file, const std::vector<std::string>& damage);

}  // namespace rovernet::cli
