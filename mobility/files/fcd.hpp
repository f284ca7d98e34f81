// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_reader.hpp"

#include <memory>

namespace rovernet {

/// Reads SUMO's floating car data (--fcd-output) in metres: <timestep> elements with <vehicle>,
/// <person> and <container> elements, whose ids are the names of the robots.
///
/// A robot moves straight from its position in one timestep to its position in the next one, and
/// arrives at the time of the next timestep. A robot that is missing in the next timestep
/// disappears at its last timestep; the robot may reappear. Robots of the last timestep remain.
/// Angles and speeds are ignored, since they follow from the positions.
/// @throws InputError
std::unique_ptr<MovementFile::Reader> read_fcd(TextSource source, MovementSyntax syntax);

}  // namespace rovernet
