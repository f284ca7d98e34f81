// SPDX-License-Identifier: MIT
#pragma once

#include "cli/traces/trace_commands.hpp"

namespace rovernet::cli {

/// Replays the inputs of a live run's log, and compares the fingerprints.
/// @throws CommandEnd if the fingerprints differ
void verify_inputs(const ReplayArguments& arguments);

}  // namespace rovernet::cli
