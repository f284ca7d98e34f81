// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <span>
#include <string>
#include <vector>

namespace rovernet {

/// Word quoted for a POSIX shell: in single quotes if necessary.
std::string shell_word(const std::string& word);

/// Words as one command for a POSIX shell.
std::string shell_command(std::span<const std::string> words);

/// Words of a command line that give the options of a scenario file.
std::vector<std::string> option_words(const ScenarioOptions& options);

}  // namespace rovernet
