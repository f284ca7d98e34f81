// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/list.hpp"
#include "models/propagation/propagation.hpp"
#include "scenario/document/value.hpp"

#include <cstddef>

// Propagation as a scenario file gives it:
//
//     [propagation]
//     model = "log_distance"
//     exponent = 2.7
//     sigma = "4 dB"

namespace rovernet {

/// [propagation]: the chosen model, and the parameters that were given for any listed model. Those
/// of other models are kept, so that one key, or a study, swaps the model.
struct PropagationTable {
    /// Index into PropagationModels; by default friis.
    std::size_t model = 1;
    /// One struct for each listed model, with its parameters.
    PropagationModels parameters;

    /// Chosen model, ready for use.
    /// @throws std::invalid_argument if a parameter is out of its range
    Propagation make() const;
};

/// Reads [propagation], or a robot's own table, over `out`. Keys of models that are not chosen may
/// stand in it.
/// @throws InputError at the first mistake, such as a parameter that the chosen model lacks
void read_propagation(const Value& value, PropagationTable& out);

/// Listed model made of a table like [propagation], shadowing off: its median loss. `rovernet loss`
/// tabulates it.
/// @throws InputError as read_propagation()
Propagation median_propagation(const Value& table);

}  // namespace rovernet
