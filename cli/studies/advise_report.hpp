// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/advise.hpp"

namespace rovernet::cli {

/// Prints an advice on models: a table of the compared candidates, the advice as a sentence, and
/// the chosen models as tables of a scenario file. With `json` all of this is printed as JSON.
void print_advice(const Advice& advice, bool json);

}  // namespace rovernet::cli
