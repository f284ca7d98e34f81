// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/advise.hpp"

namespace rovernet::cli {

/// Prints an advice: a table of what was judged, the advice in a sentence, what a control variate
/// would save, and the choice as tables of a scenario file; or all of it as JSON.
void print_advice(const Advice& advice, bool json);

}  // namespace rovernet::cli
