// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"

#include <optional>

namespace rovernet {

/// [metrics]: what is measured beyond the totals of a run. What is not asked for costs nothing.
struct MetricsTable {
    /// `reach`, which takes a look at every robot for every message; none: only while cheap
    std::optional<bool> reach = {};
    bool flows = true;      ///< each [[traffic]] table by itself
    bool robots = false;    ///< what each robot gets
    bool topology = false;  ///< degree, components, speed, how long links last

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
