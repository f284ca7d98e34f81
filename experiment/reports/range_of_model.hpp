// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/shadowed.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/propagation.hpp"

#include <optional>

namespace rovernet {

/// Range [m] of a propagation model, if the model is disc; none for any other model. Since disc
/// gives no levels, reports describe its links by distance and range, not in decibels.
inline std::optional<Meters> range_of(const Propagation& model) {
    const Shadowed* shadowed = model.as<Shadowed>();
    const Disc* disc = (shadowed ? shadowed->base() : model).as<Disc>();
    return disc ? std::optional(disc->range) : std::nullopt;
}

}  // namespace rovernet
