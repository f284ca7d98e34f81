// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <optional>

// Metrics beyond the usual ones, as a scenario file asks for them:
//
//     [metrics]
//     robots = true
//     topology = true

namespace rovernet {

/// [metrics]: what is measured beyond the totals of a run. What is not asked for costs nothing.
/// network_settings() and the run make the parts of Metrics, and the sink Topology, of it.
struct MetricsTable {
    /// Share of the robots that a chain of links joins to the sender as it sends, which takes a
    /// look at every robot for every message; none: only as long as it is cheap.
    std::optional<bool> reach = {};
    /// Metrics of each [[traffic]] table by itself.
    bool flows = true;
    /// Metrics of what each robot gets.
    bool robots = false;
    /// Metrics of the network's shape: degree, components, mean speed, lifetime of links.
    bool topology = false;

    static constexpr auto fields() {
        return describe(
            field("reach", &MetricsTable::reach,
                  "reach; if not given, as long as it costs no more than the frames"),
            field("flows", &MetricsTable::flows, "delivery, throughput, latency of each flow"),
            field("robots", &MetricsTable::robots, "the same of what each robot gets"),
            field("topology", &MetricsTable::topology,
                  "degree, components, mean speed, lifetime of links"));
    }
};

}  // namespace rovernet
