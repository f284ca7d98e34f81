// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_changes.hpp"
#include "models/medium/medium.hpp"
#include "test/scene/drawn_map.hpp"

#include <vector>

namespace rovernet::test {

/// Two moving robots and the medium between them.
struct MovingPair {
    const Scene* scene;
    Meters floor_height = no_storeys;
    Legs legs{};
    Medium medium{{.scene = scene, .floor_height = floor_height, .seed = 5}};

    void add(const Propagation& model, Leg leg, const Radio& radio = {}) {
        medium.add(radio, legs.size() + 1, model);
        legs.add(leg);
    }
    /// Times of all link changes in (after, until].
    std::vector<Time> changes(NodeId from, NodeId to, Time after, Time until,
                              const LinkSearch& search = {}) const {
        const WallPassages walls(*scene);
        std::vector<Time> all;
        while (const auto t = next_link_change(medium, legs, walls, from, to, after, until, search))
            all.push_back(after = *t);
        return all;
    }
    bool up(NodeId from, NodeId to, Time t) const {
        return medium.links().is_up(from, to, t, legs);
    }
};

inline Leg resting(Vec3 at) { return {.from = at, .to = at}; }

inline Leg moving(Vec3 from, Vec3 velocity, Duration time) {
    return {.end = start_of_run + time,
            .from = from,
            .velocity = velocity,
            .to = from + seconds(time) * velocity};
}

inline Leg random_leg(Draw& draw, double side, Duration time) {
    const auto place = [&] { return Vec3{draw.uniform(-2, side + 2), draw.uniform(-2, side + 2)}; };
    const Vec3 from = place(), to = place();
    if (draw.below(5) == 0) return resting(from);
    return {.end = start_of_run + time,
            .from = from,
            .velocity = (1 / seconds(time)) * (to - from),
            .to = to};
}

}  // namespace rovernet::test
