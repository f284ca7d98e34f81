// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/wifi.hpp"
#include "models/variation/fading.hpp"
#include "models/variation/shadowing.hpp"
#include "scene/scene_change.hpp"
#include "scene/storeys.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>

// Settings of the medium, which World makes from NetworkSettings.

namespace rovernet {

class Scene;

/// Settings of a Medium.
struct MediumSettings {
    /// Scene with its walls; not null; must outlive the medium.
    const Scene* scene = nullptr;
    /// Scenes that later replace `scene`, in ascending order of time; they must outlive the medium.
    std::span<const SceneChange> scene_changes = {};
    /// Height of one storey [m], for counting floors, see LinkBatch::floor_height.
    Meters floor_height = no_storeys;
    /// True: a frame arrives at distance / c after its transmission. False: it arrives immediately.
    bool propagation_delay = true;
    /// True: losses of pairs at rest are cached (PairCache); false: they are computed for every
    /// frame.
    bool keep_losses = true;
    /// Test mode: every pair of nodes is checked, without spatial index and cached losses.
    bool all_pairs = false;
    /// Cut-off of interference [dB]: a frame interferes if it is weaker than the sensitivity by at
    /// most this ratio, and weaker than the noise floor by at most 10 dB. Empty: only frames that
    /// are sensed interfere.
    std::optional<Db> interference_cut = std::nullopt;
    /// Physical layer of all frames, for sensitivities.
    Phy phy = Wifi{};
    /// Shadowing that is added to all propagation models. With it, no model may have a random part.
    Shadowing shadowing = {};
    /// Fading of all frames.
    Fading fading = {};
    /// Seed and replication of random draws.
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;

    /// Scene of the medium at `t`.
    const Scene& scene_at(Time t) const {
        const SceneChange* change = scene_changes.empty() ? nullptr : last_change(scene_changes, t);
        return change ? *change->scene : *scene;
    }
};

}  // namespace rovernet
