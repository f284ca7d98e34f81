// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Hint for the error message about a word that is the name of a model or a protocol in ns-2, ns-3,
/// OMNeT++ or the literature, such as "TwoRayGround" or "Mac/802_11":
///
///   did you mean "two_ray"?
///   OLSR is not there: "rovernet help not-there" lists what to use instead
///
/// Upper and lower case and all characters but letters and digits are ignored, and so are the
/// prefixes and suffixes that these simulators give to their classes.
///
/// @param word     word that was found
/// @param choices  words that are valid here; a name with a different meaning gets no hint
/// @return the hint; empty if the word is no such name
std::string simulator_name_hint(std::string_view word, const std::vector<std::string>& choices);

}  // namespace rovernet
