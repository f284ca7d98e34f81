// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"

#include <string>

/// Texts that are generated from the commands as they are declared.
namespace rovernet::cli {

/// The script with which a shell completes commands and options: bash, zsh or fish.
/// @throws std::invalid_argument for another
std::string completion_script(const Command::Text& program, const std::string& shell);

/// The page rovernet(1), for man.
std::string man_page(const Command::Text& program);

}  // namespace rovernet::cli
