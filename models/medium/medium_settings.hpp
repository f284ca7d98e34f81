// SPDX-License-Identifier: MIT
#pragma once

#include "models/variation/fading.hpp"
#include "models/variation/shadowing.hpp"
#include "scene/scene_change.hpp"
#include "scene/storeys.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>

// What a medium needs to know of its network. World makes it of NetworkSettings.

namespace rovernet {

class Scene;

/// Settings of a Medium.
struct MediumSettings {
    /// Scene with its walls; not null; outlives the medium.
    const Scene* scene = nullptr;
    /// Scenes that follow it, in ascending order of time; they outlive the medium.
    std::span<const SceneChange> scene_changes = {};
    /// Height of one storey [m], see LinkBatch.
    Meters floor_height = no_storeys;
    /// A frame arrives distance / c after it is sent; otherwise at once.
    bool propagation_delay = true;
    /// Losses of pairs at rest are kept (PairCache), instead of computing them again with every
    /// frame.
    bool keep_losses = true;
    /// Every pair is looked at, without the grid, and no losses are kept: for tests.
    bool all_pairs = false;
    /// Cut of interference [dB]: frames interfere down to so much below the sensitivity (but not to
    /// more than 10 dB below the noise floor); none: only those that are sensed do.
    std::optional<Db> interference_cut = std::nullopt;
    /// Shadowing over all propagation models; they have no random part of their own then.
    Shadowing shadowing = {};
    /// Fading of all frames.
    Fading fading = {};
    /// Seed and replication of random draws.
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;

    /// Scene at `t`.
    const Scene& scene_at(Time t) const {
        const SceneChange* change = scene_changes.empty() ? nullptr : last_change(scene_changes, t);
        return change ? *change->scene : *scene;
    }
};

}  // namespace rovernet
