// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace rovernet {

/// One passage of a segment a-b (the direct path between two points) through a wall.
struct Crossing {
    double entry;              ///< distance from the segment's start to the entry into the wall [m]
    double exit;               ///< distance from the segment's start to the exit of the wall [m]
    double length;             ///< exit - entry [m]; bitwise equal for the reversed segment
    std::size_t material = 0;  ///< material of the wall: index into Scene::materials()
    friend constexpr bool operator==(Crossing, Crossing) = default;
};

}  // namespace rovernet
