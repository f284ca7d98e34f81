// SPDX-License-Identifier: MIT
#include "mobility/waypoints.hpp"

#include "sim/fields.hpp"

#include <algorithm>

namespace rovernet {

Step Waypoints::next_leg(Mover& mover) {
    if (!positive.contains(speed.value)) {
        throw_out_of_range("waypoints", "speed", positive.text, speed.value);
    }
    auto& [places, way] = progress;
    while (true) {
        const bool by_time = places > 0 && places <= timed.size();
        if (by_time && timed[places - 1].time > mover.now) {
            const Duration left = timed[places - 1].time - mover.now;
            const double metres = way.length_left(mover);
            if (metres == 0) return straight_leg(mover, mover.position, timed[places - 1].time);
            if (auto leg = way.next_leg(mover, {metres / seconds(left)})) return *leg;
        } else if (auto leg = way.next_leg(mover, speed)) {
            return *leg;
        }
        if (places == timed.size() + path.size()) return AtRest{};
        if (places < timed.size() && timed[places].time <= mover.now) {
            ++places;
            continue;
        }
        const Vec3 to =
            places < timed.size() ? timed[places].position : path[places - timed.size()];
        ++places;
        auto planned = Way::plan(mover, to);
        if (!planned) return Blocked{to};
        way = std::move(*planned);
    }
}

}  // namespace rovernet
