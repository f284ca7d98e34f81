// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// A map: its size, walls and materials, and how much of it is free.
/// @param walls  true: an entry for each rectangle of wall; false: their number only
Table scene_report(const Scene& scene, bool walls);

/// Appends the robots of a network now, their radios, and how links join them: connected parts,
/// robots without which a part would fall apart, and the diameter in hops.
void append_robots(Table& report, const Network& network);

}  // namespace rovernet
