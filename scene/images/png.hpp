// SPDX-License-Identifier: MIT
#pragma once

#include "scene/images/image.hpp"

#include <string>

namespace rovernet {

/// Image as the bytes of a PNG file. The bytes depend only on the image and on zlib's version.
/// @throws std::invalid_argument if the image's size does not match its number of samples
std::string to_png(const Image& image);

}  // namespace rovernet
