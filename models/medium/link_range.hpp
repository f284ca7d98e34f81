// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

// Ranges of models that depend on distance, exact to the last bit.

namespace rovernet {

/// Path loss [dB] over a distance [m], with both antennas at one height on an open field.
/// @param model  of shape by_distance
double loss_at(const Propagation& model, Hertz frequency, double distance);

/// Squared range of a link [m^2]: the loss is within `budget` if and only if squared_distance(a, b)
/// of the antennas is not larger. Negative if the loss exceeds the budget even at 0 m; infinite if
/// it never does.
///
/// It is found by bisection over the representable distances, so that it agrees with the model
/// exactly, without rounding.
/// @param model  of shape by_distance
double largest_squared_distance(const Propagation& model, Hertz frequency, Db budget);

}  // namespace rovernet
