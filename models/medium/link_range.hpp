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

/// Squared range of a link [m^2]: the largest squared distance of the antennas at which the loss is
/// at most `budget`. Negative if the loss exceeds the budget at 0 m; infinite if the loss is within
/// the budget at any distance.
///
/// The range is found by bisection over the representable distances, so that it agrees exactly with
/// the model's loss.
/// @param model, height  see loss_at()
double largest_squared_distance(const Propagation& model, Hertz frequency, Db budget,
                                Meters height = {});

}  // namespace rovernet
