// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_reader.hpp"

#include <memory>

namespace rovernet {

/// Reads an ns-2 movement file: places, scheduled setdest and scheduled places of node_(0) to
/// node_(9999999). setdest means what it means in ns-2: straight from where the node then is to
/// (x, y) at the speed, where it stops; z stays; speed 0 stops it at once. A scheduled `set X_`
/// (Y_, Z_) puts the node there and ends its motion.
///
/// A file whose scheduled lines are in order of time is streamed, wherever its places stand.
/// @throws InputError
std::unique_ptr<MovementFile::Reader> read_setdest(TextSource source, MovementSyntax syntax);

}  // namespace rovernet
