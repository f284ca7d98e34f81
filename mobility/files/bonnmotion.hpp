// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_reader.hpp"

#include <memory>

namespace rovernet {

/// Reads BonnMotion's .movements: a line per node, a time and a place again and again, in metres
/// and seconds; comment lines begin with #. The node of line i, from 0, is "n<i>".
///
/// NAME.params beside NAME.movements tells whether a place is `x y` or `x y z` (`z=` and `J=`).
/// Without it, that one is taken which gives every line whole places and rising times; `x y` if
/// both do. The status that the model DisasterArea adds to each place is left out, if NAME.params
/// names this model.
/// @throws InputError
std::unique_ptr<MovementFile::Reader> read_bonnmotion(TextSource source);

}  // namespace rovernet
