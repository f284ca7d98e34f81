// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <optional>

// Optional metrics in a scenario file:
//
//     [metrics]
//     robots = true
//     topology = true

namespace rovernet {

/// [metrics]: metrics to measure besides the totals of a run. Unused metrics cost no time.
/// network_settings() and ScenarioRun configure Metrics and add the sink Topology accordingly.
struct MetricsTable {
    /// True if the metric reach is measured: number of deliveries over number of robots that are
    /// connected to the sender, by any number of hops, when the message is sent. The computing time
    /// per message grows with the number of robots. None: measured only while this time is small.
    std::optional<bool> reach = {};
    /// True if the metrics of each flow ([[traffic]] table) are measured separately.
    bool flows = true;
    /// True if the metrics of each robot as a receiver are measured separately.
    bool robots = false;
    /// True if the topology is measured: degree, components, mean speed, lifetime of links.
    bool topology = false;
    /// True if path_stretch is measured: hops of routed unicasts over hops of the shortest path at
    /// the time of sending. Each unicast requires a search of the network.
    bool path_stretch = false;

    static constexpr auto fields() {
        return describe(
            field("reach", &MetricsTable::reach,
                  "true: compute the metric reach; if not given, reach is computed unless this "
                  "takes longer than the simulation of the frames"),
            field("flows", &MetricsTable::flows,
                  "true: compute delivery, throughput and latency of each flow"),
            field("robots", &MetricsTable::robots,
                  "true: compute delivery, throughput and latency of the messages to each robot"),
            field("topology", &MetricsTable::topology,
                  "true: compute the number of neighbours, the connected components, the mean "
                  "speed of robots and the lifetime of links"),
            field("path_stretch", &MetricsTable::path_stretch,
                  "true: compute the hops of routed unicasts, divided by the hops of the shortest "
                  "path"));
    }
};

}  // namespace rovernet
