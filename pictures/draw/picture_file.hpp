// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// A picture's bytes as the kind of file that its name's ending says: .svg as it is, .png and .pdf
/// by rsvg-convert. A PDF has the time of SOURCE_DATE_EPOCH, or else 1970, so that the same picture
/// is the same bytes with the same version of that program.
/// @param path  the name; nothing is written there
/// @throws RunError if that program is missing or fails
std::string picture_bytes(const std::string& svg, const std::string& path);
/// Whether picture_bytes() knows the ending.
bool is_picture_name(const std::string& path);

}  // namespace rovernet
