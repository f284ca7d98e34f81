// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/files/movement_reader.hpp"

#include <memory>

namespace rovernet {

/// Reads a .movements file of BonnMotion: one line per node, a list of times and positions, in
/// seconds and metres; comment lines begin with #. The node of line i, from 0, is named "n<i>".
///
/// The file NAME.params beside NAME.movements determines by its keys `z` and `J` whether a position
/// is `x y` or `x y z`. Without that file, the form is used that gives every line complete
/// positions and ascending times; `x y` if both forms do. The status that the model DisasterArea
/// adds to each position is skipped, if NAME.params names this model.
/// @throws InputError
std::unique_ptr<MovementFile::Reader> read_bonnmotion(TextSource source);

}  // namespace rovernet
