// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/list.hpp"
#include "models/propagation/propagation.hpp"
#include "scenario/document/value.hpp"

#include <cstddef>

// Propagation in a scenario file:
//
//     [propagation]
//     model = "log_distance"
//     exponent = 2.7
//     sigma = "4 dB"

namespace rovernet {

/// [propagation]: the chosen model, and the given parameters of all listed models. Parameters of
/// other models are kept, so that changing the key `model` is enough to swap the model.
struct PropagationTable {
    /// Index of the chosen model in PropagationModels; by default friis.
    std::size_t model = 1;
    /// Parameters of each listed model, one struct for each.
    PropagationModels parameters;

    /// Chosen model, ready for use.
    /// @throws std::invalid_argument if a parameter is out of its range
    Propagation make() const;
};

/// Reads [propagation], or the `propagation` table of a robot, into `out`. Keys of models that are
/// not chosen are allowed.
/// @throws InputError at the first mistake, such as a missing parameter of the chosen model
void read_propagation(const Value& value, PropagationTable& out);

/// Model of a table like [propagation], without shadowing, so that its loss is the median loss.
/// Used by `rovernet loss`.
/// @throws InputError as read_propagation()
Propagation median_propagation(const Value& table);

}  // namespace rovernet
