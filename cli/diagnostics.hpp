// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

namespace rovernet::cli {

/// Says something to the person at the terminal, on standard error.
void notice(std::string_view message);
void error(std::string_view message);

/// Runs a command and turns what it throws into a message. @return the exit code
int guarded(const std::function<void()>& command);

}  // namespace rovernet::cli
