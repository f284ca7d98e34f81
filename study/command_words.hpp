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

/// Command line for a POSIX shell that consists of `words`, each quoted if necessary.
std::string shell_command(std::span<const std::string> words);

/// Command-line words that set scenario options, such as {"--set", "radio.power=15 dBm"}.
std::vector<std::string> option_words(const ScenarioOptions& options);

}  // namespace rovernet
