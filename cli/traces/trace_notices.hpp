// SPDX-License-Identifier: MIT
#pragma once

#include "traces/ns2/ns2_file.hpp"

#include <string>
#include <vector>

namespace rovernet::cli {

/// Says on standard error which lines of the trace are none of ns-2, if there are any.
void tell_refused(const std::string& file, const Ns2Counts& counts);
/// Says there what of a recorded trace is broken or missing.
void tell_damage(const std::string& file, const std::vector<std::string>& damage);

}  // namespace rovernet::cli
