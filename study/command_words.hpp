// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// A word as a POSIX shell reads it back, whatever is in it: in single quotes where it needs them.
std::string shell_word(const std::string& word);

/// Words as one command for a POSIX shell.
std::string shell_command(std::span<const std::string> words);

/// The options over a scenario's file as words of a command.
std::vector<std::string> option_words(const ScenarioOptions& options);

}  // namespace rovernet
