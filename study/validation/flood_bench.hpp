// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>
#include <vector>

namespace rovernet {

/// Movement of the robots in a flood benchmark.
enum class BenchMobility { fixed, random_waypoint };
template <>
struct EnumNames<BenchMobility> {
    static constexpr std::array<std::string_view, 2> values = {"static", "random_waypoint"};
};

/// Settings of a flood benchmark. In a flood, every robot forwards a message of 64 bytes once, at
/// 11 Mb/s with a short preamble. Robots are uniformly distributed in a square, have a range of 250
/// m, and 12 neighbours on average away from the borders.
struct FloodBench {
    std::vector<std::uint32_t> nodes = {1000};
    ReceptionTable reception = {};
    /// Model of medium access. With csma, the jitter of forwarding is 50 ms instead of 10 ms.
    AccessTable access = {};
    BenchMobility mobility = BenchMobility::fixed;  ///< fixed, or random waypoint at 1-20 m/s
                                                    ///< without pauses
    /// Scheme of `suppression` in place of a flood, with its default threshold; empty: the flood.
    std::optional<SuppressionScheme> suppression = std::nullopt;
    Db shadowing{0};  ///< standard deviation of shadowing on links [dB]; 0: none
    /// True: the floods also compute metrics, fingerprint and timeline, as `rovernet run` does.
    bool recorded = false;
    double cpu_s = 2;  ///< minimum CPU time of the floods for each network size [s]
    std::uint64_t seed = 1;
};

/// Result of a flood benchmark for one size of the network.
struct FloodBenchRow {
    std::uint32_t nodes;
    std::uint64_t transmissions;  ///< number of transmissions in all floods of the benchmark
    std::uint64_t receptions;     ///< number of received frames, including duplicates
    std::uint64_t attempts;       ///< number of robots within range, summed over all transmissions
    std::uint64_t events;         ///< number of processed events
    /// CPU time of the simulation per transmission and robot within its range [ns]: median over
    /// five parts of the benchmark.
    double ns_per_reception;
    double bfs_ns_per_edge;  ///< CPU time [ns] per edge of a breadth-first search in the graph of
                             ///< links
    double bytes_per_node;   ///< allocated memory per robot after all floods [bytes]
};

/// Runs floods in a network of `nodes` robots until the CPU time FloodBench::cpu_s is used up.
/// @throws std::invalid_argument for fewer than 2 nodes
FloodBenchRow flood_bench(const FloodBench& bench, std::uint32_t nodes);

}  // namespace rovernet
