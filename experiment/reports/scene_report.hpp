// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "scenario/scenario.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace rovernet {

/// Report of a map: size, walls, materials, and free area.
/// @param walls  true: an entry for each wall rectangle; false: only their number
Table scene_report(const Scene& scene, bool walls);

/// Appends the doors of a scene, open or closed at time `at`, and the stairs that robots of the
/// scenario use.
void append_doors_and_stairs(Table& report, const Scenario& scenario, const Scene& scene, Time at);

/// Stairs between two storeys.
struct Stairs {
    Vec3 foot, head;  ///< lower and upper end [m]
};
/// Stairs in the paths of a scenario's robots, each once.
std::vector<Stairs> stairs_of(const Scenario& scenario, const Storeys& storeys);

/// Appends the current robots of a network, their radios, and the topology: connected components,
/// articulation points (robots without which a component would split), and the diameter in hops.
void append_robots(Table& report, const Network& network);

}  // namespace rovernet
