// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/draws.hpp"
#include "mobility/movement.hpp"
#include "sim/fields.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// Place where a movement begins.
enum class StartPlace {
    uniform,  ///< drawn, uniform in the area; after the start of the run it begins where it is
    here,     ///< place where the robot is
};
template <>
struct EnumNames<StartPlace> {
    static constexpr std::array<std::string_view, 2> values = {"uniform", "here"};
};

/// The rectangle along the axes in which a robot moves. It says nothing of heights.
struct Area {
    Vec3 lower;  ///< [m]
    Vec3 upper;  ///< [m] beyond `lower` in x and y

    /// @param corners  lower-left and upper-right [m], cut to the map's box where there is a map;
    ///                 empty: the map's box
    /// @param model    for errors
    /// @throws std::invalid_argument for corners that make no area, or none without a map
    Area(const std::vector<Vec3>& corners, const Scene& scene, std::string_view model);

    bool contains(Vec3 p) const {
        return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y;
    }
    Vec3 middle() const { return 0.5 * (lower + upper); }
    double diagonal() const;      ///< [m]
    double shorter_side() const;  ///< [m]
    /// Distance to the nearest border [m] of a point inside.
    double to_border(Vec3 p) const;
    /// The place inside that is nearest to `p`.
    Vec3 clamped(Vec3 p) const;
    /// Point where the ray from `p` inside along `direction`, a vector in the plane of length 1,
    /// leaves: exactly on the border.
    Vec3 exit(Vec3 p, Vec3 direction) const;

    /// A place, uniform among those where the mover's body has room and, on a map, is on it; at the
    /// mover's height. None if 10,000 draws find none.
    std::optional<Vec3> free_place(const Mover& mover, Draws& draws) const;
    /// Place where a movement begins: at the mover for StartPlace::here or after the start of the
    /// run.
    /// @throws std::invalid_argument if that lies outside
    std::optional<Vec3> first_place(const Mover& mover, StartPlace start, Draws& draws,
                                    std::string_view model) const;
};

/// Least length of a leg [m]: a robot that could go less far stands at an obstacle or a border.
inline constexpr double least_leg = 1e-6;

/// Point up to which the mover can go straight from where it is towards `to`: `to`, or a micrometre
/// before it would touch an obstacle or leave the map; where it is, if it cannot go a least_leg.
Vec3 straight_stop(const Mover& mover, Vec3 to);

/// The vector of length 1 at `angle` [rad], counter-clockwise from the x axis.
Vec3 direction_of(double angle);
/// Direction in the plane, all equally likely: a vector of length 1.
Vec3 any_direction(const Mover& mover, Draws& draws);

}  // namespace rovernet
