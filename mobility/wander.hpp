// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/draws.hpp"
#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <cstddef>
#include <string_view>

namespace rovernet {

class LookRound;

/// A robot that avoids obstacles on its own, by what its range finder measures: it goes straight
/// ahead until an obstacle is within `keep` of its body, or for `run`. Then it looks all round,
/// turns into a direction drawn among those that are free for more than twice `keep`, the more
/// likely the farther they are free, and goes on. If none is that free it turns into the one that
/// is free the farthest; one is drawn if several are, as beyond the range.
///
/// It needs a map. Robots do not see one another.
struct Wander {
    static constexpr std::string_view name = "wander";
    static constexpr AtDoors at_doors = AtDoors::looks;

    MetersPerSecond speed{0.5};        ///< > 0
    RadiansPerSecond turn_rate{1.57};  ///< in place, > 0
    Meters keep{0.5};                  ///< free way that the body keeps ahead, > 0
    Meters range{8};                   ///< farthest that the range finder measures, > 0
    Meters run{10};                    ///< longest way straight ahead, > 0

    static constexpr auto fields() {
        return describe(
            field("speed", &Wander::speed, positive, "ahead"),
            field("turn_rate", &Wander::turn_rate, turn_rates, "in place"),
            field("keep", &Wander::keep, positive, "free way that it keeps ahead of its body"),
            field("range", &Wander::range, positive, "farthest that its range finder measures"),
            field("run", &Wander::run, positive, "longest way straight ahead"));
    }

    /// @throws std::invalid_argument for a parameter out of its range, or without a map
    Step next_leg(Mover& mover);

    /// Left to the model.
    struct Progress {
        bool begun = false;
        bool has_turned = true;  // since the last way ahead: it may go
        Draws draws = {};
    } progress = {};

  private:
    /// Angle to the direction in which it goes on [rad], counter-clockwise.
    double turn(const Mover& mover);
    // Beam that measures most; one is drawn if several do.
    std::size_t farthest(const LookRound& look, const Mover& mover);
};

}  // namespace rovernet
