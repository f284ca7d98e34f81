// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/draw/color.hpp"

#include <array>

namespace rovernet {

/// Fill of the walls of a material, on pictures and in the viewer. A map with more materials than
/// styles repeats the styles.
struct WallStyle {
    Color color;
    const char* hatch = nullptr;  ///< SVG path of a tile of hatch_size; null: filled evenly
};
inline constexpr double hatch_size = 6;  ///< width and height of a tile [px]
inline constexpr std::array wall_styles{
    WallStyle{{0x26, 0x26, 0x26}},
    WallStyle{{0x99, 0x99, 0x99}},
    WallStyle{{0x33, 0x33, 0x33}, "M-1 1L1 -1M0 6L6 0M5 7L7 5"},
    WallStyle{{0x66, 0x66, 0x66}},
    WallStyle{{0x33, 0x33, 0x33}, "M-1 5L1 7M0 0L6 6M5 -1L7 1"},
    WallStyle{{0x33, 0x33, 0x33}, "M0 3H6M3 0V6"},
};
inline constexpr Color door_color{0xd5, 0x5e, 0x00};    ///< outline of a door
inline constexpr Color stairs_color{0x00, 0x72, 0xb2};  ///< lines of stairs

}  // namespace rovernet
