// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Bytes of a picture in the format of the file name's ending: .svg unchanged, .png and .pdf by
/// rsvg-convert. A PDF has the time of SOURCE_DATE_EPOCH, or else 1970, so that equal pictures give
/// equal bytes with the same version of rsvg-convert.
/// @param path  file name; no file is written
/// @throws RunError if rsvg-convert is missing or fails
std::string picture_bytes(const std::string& svg, const std::string& path);
/// Whether picture_bytes() supports the ending of `path`.
bool is_picture_name(const std::string& path);

}  // namespace rovernet
