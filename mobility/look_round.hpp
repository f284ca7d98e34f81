// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "scene/range_finder.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

namespace rovernet {

/// Shortest time between two measurements of a robot that hardly moves [ns].
inline constexpr Duration shortest_look{10'000'000};

/// Measurement of a robot's range finder all around: distance to the nearest wall, for each degree.
class LookRound {
  public:
    static constexpr int beams = 360;
    static constexpr double step = 2 * std::numbers::pi / beams;  ///< angle between two beams [rad]

    LookRound(const Mover& mover, Meters range) : heading_(mover.heading), range_(range.value) {
        const RangeFinder finder{
            .beams = beams, .from = Radians{0}, .to = Radians{(beams - 1) * step}, .range = range};
        finder.measure(mover.scene(), mover.position, Radians{heading_}, {}, ways_);
    }

    /// Distance that a beam measures [m]; the finder's range if no wall is nearer.
    double way(std::size_t beam) const { return ways_[beam]; }
    const std::array<double, beams>& ways() const { return ways_; }
    /// Direction of a beam [rad]: the first is straight ahead, the others follow counter-clockwise.
    double direction(std::size_t beam) const { return heading_ + static_cast<double>(beam) * step; }
    /// Distance measured by the beam nearest to a direction [rad], in [m].
    double way_towards(double direction) const {
        const double beam = std::round((direction - heading_) / step);
        return ways_[static_cast<std::size_t>(std::fmod(beam + 4 * beams, beams))];
    }
    /// Index of the beam that measures the smallest distance on one side of the robot, left or
    /// right, from straight ahead to straight behind. Empty if all distances are at least the range
    /// finder's range.
    std::optional<std::size_t> nearest(bool on_the_left) const {
        std::size_t least = 0;
        for (std::size_t i = 1; i <= beams / 2; ++i) {
            const std::size_t beam = on_the_left ? i : beams - i;
            if (ways_[beam] < ways_[least]) least = beam;
        }
        return ways_[least] < range_ ? std::optional(least) : std::nullopt;
    }

  private:
    double heading_, range_;
    std::array<double, beams> ways_{};
};

}  // namespace rovernet
