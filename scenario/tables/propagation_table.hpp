// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/list.hpp"
#include "models/propagation/propagation.hpp"
#include "scenario/document/value.hpp"
#include "scenario/tables/model_choice.hpp"

// Propagation in a scenario file:
//
//     [propagation]
//     model = "log_distance"
//     exponent = 2.7
//     sigma = "4 dB"

namespace rovernet {

/// [propagation]: the chosen propagation model, and the given parameters of all such models. As
/// parameters of other models are kept, changing the key `model` is enough to swap the model.
using PropagationTable = ModelChoice<PropagationModels, Propagation, Friis>;

/// Reads [propagation], or the `propagation` table of a robot, into `out`. Keys of models that are
/// not chosen are allowed.
/// @throws InputError at the first mistake, such as a missing parameter of the chosen model
void read_propagation(const Value& value, PropagationTable& out);

/// Propagation model read from a table like [propagation], but without shadowing, so that its loss
/// is the median loss. Used by `rovernet loss`.
/// @throws InputError as read_propagation()
Propagation median_propagation(const Value& table);

}  // namespace rovernet
