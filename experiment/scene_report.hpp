// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/value.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// A map: its size, walls and materials, and how much of it is free.
/// @param walls  one entry per rectangle; else their number only
Table scene_report(const Scene& scene, bool walls);

/// The robots of a scenario at a time, their radios, and how links join them: parts that hang
/// together, robots without which one would fall apart, the longest shortest way in hops.
void append_robots(Table& report, const Network& network);

}  // namespace rovernet
