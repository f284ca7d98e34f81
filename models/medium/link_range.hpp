// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

// Ranges of propagation models that depend on distance, exact to the last bit. A model of shape
// by_heights depends on distance alone while all antennas have one height.

namespace rovernet {

/// Path loss [dB] over a distance [m] on an open field, with both antennas at the same height.
/// @param model   of shape by_distance, or by_heights
/// @param height  z of both antennas; matters with shape by_heights only
double loss_at(const Propagation& model, Hertz frequency, double distance, Meters height = {});

/// Squared range of a link [m^2]: the loss is within `budget` if and only if the squared distance
/// of the antennas is not larger. Negative if the loss exceeds the budget even at 0 m; infinite if
/// it never does.
///
/// The range is found by bisection over the representable distances, so that it agrees exactly with
/// the model's loss.
/// @param model, height  see loss_at()
double largest_squared_distance(const Propagation& model, Hertz frequency, Db budget,
                                Meters height = {});

}  // namespace rovernet
