// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/shadowed.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/propagation.hpp"

#include <optional>

namespace rovernet {

/// Range [m] of the model disc, which has no levels: its links are reported by distance and range,
/// not in decibels. None for any other model.
inline std::optional<Meters> range_of(const Propagation& model) {
    const Shadowed* shadowed = model.as<Shadowed>();
    const Disc* disc = (shadowed ? shadowed->base() : model).as<Disc>();
    return disc ? std::optional(disc->range) : std::nullopt;
}

}  // namespace rovernet
