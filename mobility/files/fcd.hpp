// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_reader.hpp"

#include <memory>

namespace rovernet {

/// Reads SUMO's floating car data (--fcd-output) in metres: <timestep>s with <vehicle>s, <person>s
/// and <container>s, whose ids are the robots' names.
///
/// A robot goes straight from its place in one timestep to that in the next, which it reaches at
/// the next one's time. One that the next timestep does not have vanishes at the time of its last;
/// it may come back. Those of the last timestep stay. Angles and speeds are not looked at: they
/// follow from the places.
/// @throws InputError
std::unique_ptr<MovementFile::Reader> read_fcd(TextSource source, MovementSyntax syntax);

}  // namespace rovernet
