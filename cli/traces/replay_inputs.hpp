// SPDX-License-Identifier: MIT
#pragma once

#include "cli/traces/trace_commands.hpp"

namespace rovernet::cli {

/// Runs a live run's scenario again with the inputs of its log, and compares the fingerprints.
/// @throws CommandEnd if they differ
void verify_inputs(const ReplayArguments& arguments);

}  // namespace rovernet::cli
