// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"

#include <string>

/// Texts generated from the declarations of all commands: shell completion and man page.
namespace rovernet::cli {

/// Completion script for a shell: bash, zsh or fish.
/// @throws std::invalid_argument for any other shell
std::string completion_script(const Command::Text& program, const std::string& shell);

/// Text of the man page rovernet(1).
std::string man_page(const Command::Text& program);

}  // namespace rovernet::cli
