// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
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

/// Settings of a Network, all with defaults: an open field, free space, and frames that do not
/// interfere and are transmitted immediately.
///
///   Network network({.seed = 7, .propagation = LogDistance{}, .reception = Sinr{},
///                    .access = Csma{}});
struct NetworkSettings {
    /// Seed of all random draws, and number of the independent repetition.
    std::uint64_t seed = 1;
    std::uint32_t replication = 0;
    /// Propagation model of robots without a model of their own.
    Propagation propagation = Friis{};
    /// Shadowing, added to the propagation models of all robots. It is an error if such a model has
    /// a random part of its own.
    Shadowing shadowing = {};
    /// Fading of frames: random variation of the power of each frame.
    Fading fading = {};
    /// Scene with walls; null for an open field.
    std::shared_ptr<const Scene> scene = nullptr;
    /// Scenes that later replace `scene`, in ascending order of time, see scene_changes(). Robots
    /// plan their paths in `scene`, where all doors are open.
    std::vector<SceneChange> scene_changes = {};
    /// Path planners of `scene` that were made in an earlier run; null: the Network makes new ones.
    /// See KeptPlanners.
    std::shared_ptr<Planners> planners = nullptr;
    /// Height of one storey [m], for losses per floor; see LinkBatch.
    Meters floor_height = no_storeys;
    /// Precision of the search for link changes.
    LinkSearch links = {};
    /// Reception model: determines the fate of frames at a receiver.
    ReceptionModel reception = Threshold{};
    /// Access model: determines when robots may transmit.
    AccessModel access = NoAccess{};
    /// Address resolution before the first unicast to a neighbour; off by default.
    ArpSettings arp = {};
    /// True: frames travel at the speed of light; false: frames arrive without delay.
    bool propagation_delay = true;
    /// Largest number of events of a run; with more events RunError is thrown. The limit stops a
    /// run that schedules events without end.
    std::uint64_t event_limit = 100'000'000;
    /// Reference mode for tests: checks every pair of robots, and serves receptions at different
    /// times by separate events. The mode is slow; its records must equal those of the fast
    /// methods.
    bool reference = false;
    /// True: the network computes Metrics, for Network::metrics().
    bool metrics = true;
    /// Parts of the traffic (flows, robots) for which Metrics are also computed separately.
    MetricParts metric_parts = {};
    /// Function that returns the scenario as TOML for sinks, see RunInfo; empty if the network was
    /// built by a C++ program.
    std::function<std::string()> scenario = {};
    /// Warm-up time [ns]: Metrics leave out the messages of this time.
    Duration warmup{0};
};

}  // namespace rovernet
