// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace rovernet {

/// One passage of a segment a-b through a wall; entry and exit are distances from a.
struct Crossing {
    double entry;              ///< distance of the entry from a [m]
    double exit;               ///< distance of the exit from a [m]
    double length;             ///< exit - entry [m]; the same bits from a to b as from b to a
    std::size_t material = 0;  ///< index into Scene::materials()
    friend constexpr bool operator==(Crossing, Crossing) = default;
};

}  // namespace rovernet
