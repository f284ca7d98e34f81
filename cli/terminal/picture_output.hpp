// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet::cli {

/// Refuses a picture's name before anything is computed for it.
/// @param out  of the option --output
/// @throws InputError unless it ends in .svg, .png or .pdf
void check_picture_name(const std::string& out);

/// Writes a picture as its name's ending says, or nothing of it. @throws RunError
void write_picture(const std::string& out, const std::string& svg);

}  // namespace rovernet::cli
