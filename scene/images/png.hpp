// SPDX-License-Identifier: MIT
#pragma once

#include "scene/images/image.hpp"

#include <string>

namespace rovernet {

/// The picture as a PNG file's bytes. They depend on nothing but the picture and zlib's version.
/// @throws std::invalid_argument if the picture's sizes and samples do not fit together
std::string to_png(const Image& image);

}  // namespace rovernet
