// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace rovernet {

/// Report of a scene as a table: size, walls, materials, and free area.
/// @param walls  true: an entry for each wall rectangle; false: only the number of rectangles
Table scene_report(const Scene& scene, bool walls);

/// Appends to a report the doors of a scene, with their states (open or closed) at the time `at`,
/// and the stairs that robots of the scenario use.
void append_doors_and_stairs(Table& report, const Scenario& scenario, const Scene& scene, Time at);

/// Stairs between two storeys.
struct Stairs {
    Vec3 foot, head;  ///< lower and upper end [m]
};
/// Stairs that the paths of a scenario's robots use. Stairs used by several paths are listed once.
std::vector<Stairs> stairs_of(const Scenario& scenario, const Storeys& storeys);

/// Appends to a report the robots of a network in their current state, their radios, and the
/// topology: connected components, articulation points (robots without which a component would
/// split), and the diameter [hops].
void append_robots(Table& report, const Network& network);

}  // namespace rovernet
