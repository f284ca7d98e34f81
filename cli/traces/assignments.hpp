// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace rovernet::cli {

/// Assignments "path=value" of one option --with: "a=1;b=2".
std::vector<std::string> assignments(const std::string& with);

}  // namespace rovernet::cli
