// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/worldfile.hpp"
#include "sim/geometry.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Role of a model of a Stage world for radio.
enum class WorldRole {
    robot,    ///< a position
    wall,     ///< a model
    radio,    ///< a wifi
    shape,    ///< a block: a part of its model's body
    ignored,  ///< sensors, tools, windows
};

/// Role of a model, by its type. A type that Stage does not know is a robot if it has a wifi, else
/// a wall if it has a bitmap: so it is with macros whose include is missing.
WorldRole world_role(const WorldEntity& entity);

/// The types of Stage 2 to 4.
const std::vector<std::string>& stage_types();

/// The `wifi` of a model: its own and those of its parts, not those of other positions in it.
std::vector<const WorldEntity*> wifis(const WorldEntity& entity);

/// Units of the file.
struct WorldUnits {
    double metres = 1;   ///< [m] by unit_length: "m", "cm" or "mm"
    double degrees = 1;  ///< [deg] by unit_angle: "degrees" or "radians"
};

/// @throws InputError for a unit that Stage does not know
WorldUnits world_units(const WorldFile& world);

/// A place and a direction, in the frame of the parent or of the world.
struct WorldPose {
    Vec3 at{};           ///< [m]
    double degrees = 0;  ///< counter-clockwise from the x axis
};

/// `inner`, given in the frame of `outer`, in the frame that `outer` is given in. z does not add.
WorldPose operator*(const WorldPose& outer, const WorldPose& inner);

/// [x y], [x y a] (Stage 2) or [x y z a] (Stage 3 and 4) under `key`; all 0 without it.
/// @throws InputError for anything else, and beyond 1e9 m
WorldPose world_pose(const WorldEntity& entity, std::string_view key, const WorldUnits& units);
WorldPose world_pose(const WorldProperty& property, const WorldUnits& units);

/// Extents along the model's own axes [m], >= 0.
struct WorldSize {
    double x = 0;
    double y = 0;
};

/// The key size, [x y] (Stage 2) or [x y z] (Stage 3 and 4); 0.4 m both ways, Stage 4's default,
/// without it. @throws InputError for anything else, below 0 and beyond 1e9 m
WorldSize world_size(const WorldEntity& entity, const WorldUnits& units);

/// Sine and cosine of an angle in degrees, exact for multiples of 90.
struct Direction {
    double sine = 0;
    double cosine = 1;
};
Direction direction(double degrees);

}  // namespace rovernet
