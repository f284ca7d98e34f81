// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

// Ranges of propagation models that depend on distance, exact to the last bit.

namespace rovernet {

/// Path loss [dB] over a distance [m] on an open field, with both antennas at the same height.
/// @param model  of shape by_distance
double loss_at(const Propagation& model, Hertz frequency, double distance);

/// Squared range of a link [m^2]: the loss is within `budget` if and only if the squared distance
/// of the antennas is not larger. Negative if the loss exceeds the budget even at 0 m; infinite if
/// it never does.
///
/// The range is found by bisection over the representable distances, so that it agrees exactly with
/// the model's loss.
/// @param model  of shape by_distance
double largest_squared_distance(const Propagation& model, Hertz frequency, Db budget);

}  // namespace rovernet
