// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <string_view>
#include <vector>

namespace rovernet {

/// Up and down an area in parallel lanes, as a mower goes; straight, whatever stands in the way.
struct Lanes {
    static constexpr std::string_view name = "lanes";

    std::vector<Vec3> area = {};  ///< [m] lower-left and upper-right corner
    Meters width{1};              ///< [m] of a lane, > 0
    MetersPerSecond speed{1};     ///< [m/s], > 0

    static constexpr auto fields() {
        return describe(field("area", &Lanes::area, "lower-left and upper-right corner"),
                        field("width", &Lanes::width, positive, "of a lane"),
                        field("speed", &Lanes::speed, positive, "along the lanes"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

  private:
    int corner_ = 0;  // of the way, gone to so far
};

}  // namespace rovernet
