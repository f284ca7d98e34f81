// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/no_access.hpp"
#include "models/links/link_search.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/propagation.hpp"
#include "models/reception/judge.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"
#include "traces/metrics.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace rovernet {

class Planners;
class Scene;

/// What a Network is made with.
struct NetworkSettings {
    std::uint64_t seed = 1;
    std::uint32_t replication = 0;
    Propagation propagation = Friis{};             ///< of robots that do not have their own
    std::shared_ptr<const Scene> scene = nullptr;  ///< null: an open field
    /// Planners of the scene, if some are kept from an earlier run in it; see KeptPlanners.
    std::shared_ptr<Planners> planners = nullptr;
    Meters floor_height{3};                   ///< [m] of one storey
    LinkSearch links = {};                    ///< how link changes are looked for
    ReceptionModel reception = Threshold{};   ///< what becomes of frames at a receiver
    AccessModel access = NoAccess{};          ///< how robots get access to the medium
    bool propagation_delay = true;            ///< frames travel at the speed of light
    std::uint64_t event_limit = 100'000'000;  ///< a run that needs more events fails
    /// For tests: looks at every pair of robots; receptions at different times are separate events.
    /// Slow, and the same to the last record.
    bool reference = false;
    bool metrics = true;            ///< keep Metrics
    MetricParts metric_parts = {};  ///< which parts of the traffic they count one by one
    /// The scenario as TOML for sinks that ask for it, see RunInfo; empty: a network made in code.
    std::function<std::string()> scenario = {};
    Duration warmup{0};  ///< Metrics leave out the messages that are sent before it is over
};

}  // namespace rovernet
