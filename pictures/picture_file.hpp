// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Writes a picture as the kind of file that its name's ending says: .svg as it is, .png and .pdf
/// by rsvg-convert; `path` never holds half of it. A PDF has the time of SOURCE_DATE_EPOCH, or else
/// 1970, so that the same picture is the same bytes with the same version of that program.
/// @throws RunError if that program is missing or fails, or the file cannot be written
void write_picture(const std::string& svg, const std::string& path);
/// Whether write_picture() knows the ending.
bool is_picture_name(const std::string& path);

}  // namespace rovernet
