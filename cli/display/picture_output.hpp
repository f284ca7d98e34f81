// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet::cli {

/// Checks the file name of a picture, before the picture is computed.
/// @param out  file name: the value of the option --output
/// @throws InputError unless the name ends in .svg, .png or .pdf
void check_picture_name(const std::string& out);

/// Writes a picture, given as SVG, in the format that the ending of the file name `out` determines.
/// The file is written completely or not at all.
/// @throws RunError
void write_picture(const std::string& out, const std::string& svg);

}  // namespace rovernet::cli
