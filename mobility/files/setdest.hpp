// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_reader.hpp"

#include <memory>

namespace rovernet {

/// Reads an ns-2 movement file: positions, scheduled setdest and scheduled positions of node_(0) to
/// node_(9999999). setdest works as in ns-2: the node moves straight from its position at that time
/// to (x, y) at the given speed and stops there; z is constant; speed 0 stops the node immediately.
/// A scheduled `set X_` (Y_, Z_) moves the node to that coordinate immediately and ends its motion.
///
/// A file whose scheduled lines are in order of time is streamed; unscheduled positions may be
/// anywhere in the file.
/// @throws InputError
std::unique_ptr<MovementFile::Reader> read_setdest(TextSource source, MovementSyntax syntax);

}  // namespace rovernet
