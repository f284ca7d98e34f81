// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/list.hpp"
#include "models/propagation/propagation.hpp"
#include "scenario/value.hpp"

#include <cstddef>

namespace rovernet {

/// [propagation]: the chosen model, and the parameters given for any listed model.
struct PropagationTable {
    std::size_t model = 1;  ///< index into PropagationModels
    PropagationModels parameters;

    /// @throws std::invalid_argument if a parameter is out of its range
    Propagation make() const;
};

/// A listed model from the table of a [propagation], shadowing off.
Propagation median_propagation(const Value& table);

}  // namespace rovernet
