// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Boolean value of a word in upper or lower case: true for "true", "yes" and "on"; false for
/// "false", "no" and "off". Empty for any other word.
std::optional<bool> truth_in(std::string_view word);

/// Hints for the error message about a word that is not in an enumeration.
struct ChoiceHelp {
    /// Meaning of each word; empty: no explanation is printed.
    std::vector<std::string_view> meanings = {};
    std::string_view yes = {};     ///< word to suggest if the user wrote "on"; empty: none
    std::string_view no = "none";  ///< word to suggest if the user wrote "off"
};

/// Reads a word that must be one of `choices`; `help` adds hints to the error message.
/// @param key  name of the value's key, for the error message
/// @return index of the word in `choices`
/// @throws InputError for an unknown word; the message lists all choices and suggests the most
///         similar one, also by names of other simulators (simulator_names.hpp). A word that
///         differs from the unknown word in a digit (ns2, ns3) is not suggested
std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices, const ChoiceHelp& help);

}  // namespace rovernet
