// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <string_view>
#include <vector>

namespace rovernet {

/// Movement up and down an area in parallel lanes, like a lawn mower; straight through obstacles.
struct Lanes {
    static constexpr std::string_view name = "lanes";

    std::vector<Vec3> area = {};  ///< [m] lower-left and upper-right corner
    Meters width{1};              ///< width of a lane [m], > 0
    MetersPerSecond speed{1};     ///< speed [m/s], > 0

    static constexpr auto fields() {
        return describe(field("area", &Lanes::area, "lower-left and upper-right corner"),
                        field("width", &Lanes::width, positive, "of a lane"),
                        field("speed", &Lanes::speed, positive, "along the lanes"));
    }

    /// @throws std::invalid_argument for a parameter out of its range
    Step next_leg(Mover& mover);

  private:
    int corner_ = 0;  // number of corners of the path reached so far
};

}  // namespace rovernet
