// SPDX-License-Identifier: MIT
#pragma once

#include "scene/stage/worldfile.hpp"
#include "sim/geometry.hpp"
#include "sim/power_of_ten.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Role of a Stage model for the radio simulation.
enum class WorldRole {
    robot,    ///< model type "position"
    wall,     ///< model type "model"
    radio,    ///< model type "wifi"
    shape,    ///< model type "block": a part of the body of its parent model
    ignored,  ///< other model types: sensors, tools, windows
};

/// Role of a Stage model, by its type. A model whose type is unknown to Stage (a macro whose
/// include is missing) is a robot if it has a wifi, or else a wall if it has a bitmap.
WorldRole world_role(const WorldEntity& entity);

/// Model types of Stage 2 to 4.
const std::vector<std::string>& stage_types();

/// All `wifi` models in a Stage model and in its parts. The `wifi` models of a nested `position`
/// (robot) are not included.
std::vector<const WorldEntity*> wifis(const WorldEntity& entity);

/// Units of length and angle of a world file.
struct WorldUnits {
    int length_exponent = 0;  ///< power of ten of unit_length [m]: 0 "m", -2 "cm", -3 "mm"
    double degrees = 1;       ///< size of unit_angle [deg]: 1 for "degrees", 180 / pi for "radians"

    /// Length [m] for a number in the file's unit of length.
    double metres(double number) const { return times_power_of_ten(number, length_exponent); }
};

/// Units of length and angle that a world file sets. @throws InputError for a unit unknown to Stage
WorldUnits world_units(const WorldFile& world);

/// Pose (position and direction) of a Stage model, in the frame of its parent or of the world.
struct WorldPose {
    Vec3 at{};           ///< position [m]
    double degrees = 0;  ///< direction [deg], counter-clockwise from the x axis
};

/// Composition of poses: `inner` is given in the frame of `outer`; the result is in the parent
/// frame of `outer`. Heights z are not added.
WorldPose operator*(const WorldPose& outer, const WorldPose& inner);

/// Pose given by `key`: [x y], [x y a] (Stage 2) or [x y z a] (Stage 3 and 4); all 0 without `key`.
/// @throws InputError for any other value, and for coordinates beyond 1e9 m
WorldPose world_pose(const WorldEntity& entity, std::string_view key, const WorldUnits& units);
WorldPose world_pose(const WorldProperty& property, const WorldUnits& units);

/// Extents of a model along its own axes [m], >= 0.
struct WorldSize {
    double x = 0;
    double y = 0;
};

/// Size of a Stage model, given by the key `size`: [x y] (Stage 2) or [x y z] (Stage 3 and 4).
/// Without the key the size is 0.4 m x 0.4 m, the default of Stage 4.
/// @throws InputError for any other value, and for lengths below 0 or above 1e9 m
WorldSize world_size(const WorldEntity& entity, const WorldUnits& units);

/// Sine and cosine of an angle in degrees, exact for multiples of 90.
struct Direction {
    double sine = 0;
    double cosine = 1;
};
Direction direction(double degrees);

}  // namespace rovernet
