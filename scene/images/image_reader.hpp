// SPDX-License-Identifier: MIT
#pragma once

#include "scene/images/image.hpp"

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace rovernet {

/// Throws an error about an image file.
/// @throws InputError always
[[noreturn]] void image_error(const std::string& path, const std::string& message);

/// Checks the image size in a header, before memory is allocated.
/// @throws InputError unless the image has between 1 and max_image_pixels pixels
void check_image_size(const std::string& path, std::int64_t width, std::int64_t height);

/// Image of the given size [pixels] and number of channels, with all samples 0.
/// @throws InputError as check_image_size()
Image sized_image(const std::string& path, std::int64_t width, std::int64_t height, int channels);

/// Reads the pixels of a Netpbm image: PBM (P1, P4), PGM (P2, P5) or PPM (P3, P6), maxval 1 to
/// 65535.
///
/// Source: the Netpbm manual, "PBM, PGM and PPM Format Specification".
/// @param file  positioned behind the two characters of the magic number
/// @param kind  digit of the magic number, '1' to '6'
/// @throws InputError if the file is damaged or too large
Image read_netpbm(const std::string& path, std::FILE* file, char kind);

/// Reads the pixels of a JPEG, BMP or GIF (its first frame) with the library stb_image.
///
/// Palettes are expanded. A GIF without transparent pixels has no alpha channel.
/// @param file  positioned at its start
/// @param kind  name of the format, for errors
/// @throws InputError if the file is damaged, too large or of a variant that the library cannot
///         read
Image read_by_library(const std::string& path, std::FILE* file, std::string_view kind);

}  // namespace rovernet
