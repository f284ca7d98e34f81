// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace rovernet::cli {

/// Says something to the person at the terminal, on standard error.
void notice(std::string_view message);
void error(std::string_view message);

}  // namespace rovernet::cli
