// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/run.hpp"

namespace rovernet::cli {

/// Prints the results of a run, as text or as JSON.
void print_run(const Scenario& scenario, const RunResult& result, bool json);

}  // namespace rovernet::cli
