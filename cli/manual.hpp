// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

#include <initializer_list>
#include <string>

/// Texts that are generated from the commands as they are declared.
namespace rovernet::cli {

/// Shows these lines under "Examples" in the command's --help and in the man page.
void add_examples(CLI::App& command, std::initializer_list<const char*> lines);

/// The script with which a shell completes commands and options: bash, zsh or fish.
/// @throws std::invalid_argument for another
std::string completion_script(const CLI::App& app, const std::string& shell);

/// The page rovernet(1), for man.
std::string man_page(const CLI::App& app);

}  // namespace rovernet::cli
