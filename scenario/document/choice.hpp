// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Boolean value of a word, upper or lower case: true, yes, on; false, no, off. Nothing for any
/// other word.
std::optional<bool> truth_in(std::string_view word);

/// Hints for the error message about a word that is not in an enumeration.
struct ChoiceHelp {
    /// Meaning of each word; empty: no explanation is printed.
    std::vector<std::string_view> meanings = {};
    std::string_view yes = {};     ///< word of the enumeration to suggest for "on"; empty: none
    std::string_view no = "none";  ///< word of the enumeration to suggest for "off"
};

/// Finds a word in the list of an enumeration, as read_choice() in scenario/tables/read_value.hpp.
/// @return index into `choices`
/// @throws InputError for an unknown word; the message lists all choices and suggests the most
///         similar one. Words that differ in a digit (ns2, ns3) mean different things and are not
///         suggested
std::size_t read_choice(const Value& value, std::string_view key,
                        const std::vector<std::string>& choices, const ChoiceHelp& help);

}  // namespace rovernet
