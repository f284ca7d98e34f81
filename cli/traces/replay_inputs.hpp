// SPDX-License-Identifier: MIT
#pragma once

#include "cli/traces/trace_commands.hpp"

namespace rovernet::cli {

/// Runs a scenario again with the inputs (commands) that a log of a live run contains, and compares
/// the fingerprint of the new run with the fingerprint in the log.
/// @throws CommandEnd if the fingerprints differ
void verify_inputs(const ReplayArguments& arguments);

}  // namespace rovernet::cli
