// SPDX-License-Identifier: MIT
#include "mobility/patrol.hpp"

namespace rovernet {

Step Patrol::next_leg(Mover& mover) {
    check_fields(*this, name);
    if (path.empty()) throw std::invalid_argument("patrol: path must have at least one place");
    auto& [next, way] = progress;
    for (std::size_t tried = 0;; ++tried) {
        if (auto leg = way.next_leg(mover, speed)) return *leg;
        if (tried == path.size()) return AtRest{};
        const Vec3 goal = path[next];
        next = (next + 1) % path.size();
        auto planned = Way::plan(mover, goal);
        if (!planned) return Blocked{goal};
        way = std::move(*planned);
    }
}

}  // namespace rovernet
