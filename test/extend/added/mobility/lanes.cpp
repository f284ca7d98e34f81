// SPDX-License-Identifier: MIT
#include "mobility/lanes.hpp"

#include <stdexcept>

namespace rovernet {

Step Lanes::next_leg(Mover& mover) {
    check_fields(*this, name);
    if (area.size() != 2) throw std::invalid_argument("lanes: area must have two corners");
    for (;;) {
        const int lane = corner_ / 2;
        const bool at_top = corner_ % 4 == 1 || corner_ % 4 == 2;
        const Vec3 corner{area[0].x + lane * width.value, at_top ? area[1].y : area[0].y};
        if (corner.x > area[1].x) return AtRest{};
        ++corner_;
        if (corner != mover.position) return straight_leg(mover, corner, speed);
    }
}

}  // namespace rovernet
