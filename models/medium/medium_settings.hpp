// SPDX-License-Identifier: MIT
#pragma once

#include "sim/units.hpp"

#include <cstdint>
#include <optional>

namespace rovernet {

class Scene;

/// What a Medium is made with.
struct MediumSettings {
    const Scene* scene = nullptr;   ///< not null; outlives the medium
    Meters floor_height{3};         ///< [m] of one storey
    bool propagation_delay = true;  ///< a frame arrives distance / c after it is sent
    bool keep_losses = true;        ///< of pairs at rest, instead of computing them again
    bool all_pairs = false;         ///< for tests: without the grid, nor losses kept
    /// [dB] frames disturb others down to so much below the sensitivity (but not to more than
    /// 10 dB below the noise floor); none: only those that are sensed do.
    std::optional<Db> interference_cut = std::nullopt;
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;
};

}  // namespace rovernet
