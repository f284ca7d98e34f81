// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <string>
#include <string_view>

namespace rovernet {

/// Reason why a robot does not fit at a place, if the obstacle nearest to the place is an unknown
/// cell of the map: "is in an unknown cell of the map; ...", with a way to make the cell free.
/// Empty if the nearest obstacle is a wall, or farther away than the radius.
/// @param at      centre of the robot [m]
/// @param radius  radius of the robot [m]
/// @param whose   name of the radius in the text, such as "its radius"
std::string unknown_cell_text(const Scene& scene, Vec3 at, Meters radius, std::string_view whose);

}  // namespace rovernet
