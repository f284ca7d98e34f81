// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// Choice of the position at which a movement model starts a robot.
enum class StartPlace {
    uniform,  ///< uniform random position in the area; the robot's current position if the
              ///< movement begins after the start of the run
    here,     ///< current position of the robot
};
/// Names of the values of `start` in scenario files.
template <>
struct EnumNames<StartPlace> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "here"};
};

/// Axis-parallel rectangle in which a robot moves; heights are not limited.
struct Area {
    Vec3 lower;  ///< lower-left corner [m]
    Vec3 upper;  ///< upper-right corner [m], beyond `lower` in x and y

    /// @param corners  lower-left and upper-right corner [m], limited to the map's box if the map
    ///                 has a border; empty: the box around the map, or around the walls of a world
    /// @param model    name of the model, for errors
    /// @throws std::invalid_argument if the corners enclose no area, or if there are neither
    ///         corners nor a map
    Area(const std::vector<Vec3>& corners, const Scene& scene, std::string_view model);

    bool contains(Vec3 p) const {
        return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y;
    }
    Vec3 middle() const { return 0.5 * (lower + upper); }
    double diagonal() const;      ///< length of the diagonal [m]
    double shorter_side() const;  ///< length of the shorter side [m]
    /// Distance [m] of a point inside the area to its nearest border.
    double to_border(Vec3 p) const;
    /// Point of the area nearest to `p`.
    Vec3 clamped(Vec3 p) const;
    /// Point at which a ray crosses the area's border. The ray starts at `p`, inside the area, and
    /// has the direction `direction`, a horizontal unit vector. The point lies exactly on the
    /// border.
    Vec3 exit(Vec3 p, Vec3 direction) const;

    /// Uniform random position in the area at which the mover's body touches no obstacle. If the
    /// map has a border, the position is on the map. The position has the mover's height. Empty if
    /// 10,000 draws find no such position.
    std::optional<Vec3> free_place(const Mover& mover, Draws& draws) const;
    /// Start position of a movement in the area. It is random, by free_place(), if `start` is
    /// StartPlace::uniform and the movement begins at the start of the run. In all other cases it
    /// is the mover's current position.
    /// @return empty if free_place() finds no position
    /// @throws std::invalid_argument if the mover's current position is needed but lies outside the
    ///         area
    std::optional<Vec3> first_place(const Mover& mover, StartPlace start, Draws& draws,
                                    std::string_view model) const;
};

/// Length of the shortest leg (piece of movement) [m]. A robot that cannot move so far before an
/// obstacle or a border stands still.
inline constexpr double least_leg = 1e-6;

/// Fraction [-] of a path along which a robot can move before an obstacle, found by bisection.
/// @param open  open(f): whether the robot can move along the first fraction f of the path
/// @param off   fraction of the path that has the length least_leg
/// @return 1 for the whole path; otherwise the free fraction minus `off`; 0 if less than `off` is
///        left
template <class Open>
double free_share(Open open, double off) {
    if (open(1.0)) return 1;
    double good = 0, bad = 1;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (good + bad);
        (open(middle) ? good : bad) = middle;
    }
    // The stop keeps a distance from the obstacle. At the obstacle, rounding would decide whether
    // the next leg may begin.
    good -= off;
    return good >= off && open(good) ? good : 0;
}

/// End of the longest free straight path of the mover towards `to`. The result is `to`, or a
/// position a micrometre before an obstacle or the map's border. If the mover cannot move by
/// least_leg, the result is the mover's position.
Vec3 straight_stop(const Mover& mover, Vec3 to);

/// Unit vector at `angle` [rad], counter-clockwise from the x axis.
Vec3 direction_of(double angle);
/// Uniform random direction in the plane, as a unit vector.
Vec3 any_direction(const Mover& mover, Draws& draws);

}  // namespace rovernet
