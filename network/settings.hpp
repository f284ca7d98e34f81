// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/no_access.hpp"
#include "models/links/link_search.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/propagation.hpp"
#include "models/reception/judge.hpp"
#include "models/variation/fading.hpp"
#include "models/variation/shadowing.hpp"
#include "scene/scene_change.hpp"
#include "scene/storeys.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"
#include "traces/metric_values.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rovernet {

class Planners;
class Scene;

/// Settings of a Network, all with defaults: an open field, free space, frames that do not
/// interfere and go on air at once.
///
///   Network network({.seed = 7, .propagation = LogDistance{}, .reception = Sinr{}, .access =
///   Csma{}});
struct NetworkSettings {
    /// Seed of all random draws, and number of the independent repetition.
    std::uint64_t seed = 1;
    std::uint32_t replication = 0;
    /// Propagation model of robots that do not have their own.
    Propagation propagation = Friis{};
    /// Shadowing over the propagation models of all robots; these are not random themselves then.
    Shadowing shadowing = {};
    /// Fading of frames.
    Fading fading = {};
    /// Scene with walls; null: an open field.
    std::shared_ptr<const Scene> scene = nullptr;
    /// Scenes that follow it, in ascending order of time, see scene_changes(). Robots plan their
    /// ways in `scene`, where all doors are open.
    std::vector<SceneChange> scene_changes = {};
    /// Planners of the scene, if some are kept from an earlier run in it; see KeptPlanners.
    std::shared_ptr<Planners> planners = nullptr;
    /// Height of one storey [m], for losses by floor; see LinkBatch.
    Meters floor_height = no_storeys;
    /// Precision with which link changes are looked for.
    LinkSearch links = {};
    /// Reception model: what becomes of frames at a receiver.
    ReceptionModel reception = Threshold{};
    /// Access model: how robots get access to the medium.
    AccessModel access = NoAccess{};
    /// Frames travel at the speed of light; otherwise they arrive at once.
    bool propagation_delay = true;
    /// Events that a run may need; one that needs more fails by a RunError. It catches what
    /// schedules without end.
    std::uint64_t event_limit = 100'000'000;
    /// Reference for tests: looks at every pair of robots, and serves receptions at different times
    /// by separate events. Slow, and the same to the last record: what is fast has to agree with
    /// it.
    bool reference = false;
    /// The network keeps Metrics, for Network::metrics().
    bool metrics = true;
    /// Parts of the traffic that they count one by one.
    MetricParts metric_parts = {};
    /// Scenario as TOML for sinks that ask for it, see RunInfo; empty: a network made in code.
    std::function<std::string()> scenario = {};
    /// Time [ns] whose messages Metrics leave out.
    Duration warmup{0};
};

}  // namespace rovernet
