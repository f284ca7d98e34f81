// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Movement of the robots of a flood bench.
enum class BenchMobility { fixed, random_waypoint };
template <>
struct EnumNames<BenchMobility> {
    static constexpr std::array<std::string_view, 2> values = {"static", "random_waypoint"};
};

/// Settings of a flood bench: messages of 64 bytes that every robot forwards once, at 11 Mb/s with
/// a short preamble. Robots are uniform in a square, hear each other up to 250 m and have 12
/// neighbours on average, away from its borders.
struct FloodBench {
    std::vector<std::uint32_t> nodes = {1000};
    ReceptionChoice reception = ReceptionChoice::threshold;
    AccessChoice access = AccessChoice::none;       ///< csma: jitter of 50 ms instead of 10 ms
    BenchMobility mobility = BenchMobility::fixed;  ///< random waypoint: 1-20 m/s, no rest
    Db shadowing{0};        ///< shadowing of each link; 0: links go by distance alone
    bool recorded = false;  ///< with metrics, fingerprint and timeline, as in `rovernet run`
    double cpu_s = 2;       ///< CPU time that each row takes at least [s]
    std::uint64_t seed = 1;
};

/// Result for one size of network.
struct FloodBenchRow {
    std::uint32_t nodes;
    std::uint64_t transmissions;  ///< transmissions of all floods
    std::uint64_t receptions;     ///< copies decoded, duplicates included
    std::uint64_t attempts;       ///< robots within the decode range of a transmission
    std::uint64_t events;         ///< events served
    double ns_per_reception;      ///< [ns] CPU per attempt: the median of five parts of the time
    double bfs_ns_per_edge;       ///< [ns] per edge of a breadth-first search of the same graph
    double bytes_per_node;        ///< memory of the network after the floods [bytes]
};

/// Floods until the CPU time is spent. @throws std::invalid_argument for fewer than 2 nodes
FloodBenchRow flood_bench(const FloodBench& bench, std::uint32_t nodes);

}  // namespace rovernet
