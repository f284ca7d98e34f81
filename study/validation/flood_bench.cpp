// SPDX-License-Identifier: MIT
#include "study/validation/flood_bench.hpp"

#include "experiment/run.hpp"
#include "experiment/session.hpp"
#include "mobility/random_waypoint.hpp"
#include "network/network.hpp"
#include "sim/fate.hpp"
#include "sim/math.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <malloc.h>
#include <numbers>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double decode_range = 250;    // [m]
constexpr double sensing_range = 550;   // [m] of reception models with interference
constexpr double mean_neighbours = 12;  // where there is no border
constexpr std::uint32_t payload = 64;   // [bytes]

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Bytes that this process has allocated and not freed.
double allocated() {
    const auto now = mallinfo2();
    return static_cast<double>(now.uordblks) + static_cast<double>(now.hblkhd);
}

double side(std::uint32_t nodes) {
    return decode_range * std::sqrt(std::numbers::pi * nodes / mean_neighbours);
}

/// Receptions of the floods of a network.
struct Tally {
    std::uint64_t attempts = 0, decoded = 0;
};

/// Counts receptions, where no metrics do.
struct Count : Tally {
    KindMask kinds() const { return kind_of<Received>(); }
    void on(const Record& record, const RecordContext&) {
        const auto receptions = std::get<Received>(record).receptions;
        attempts += receptions.size();
        for (const Reception& r : receptions) decoded += is_decoded(r.fate);
    }
};

/// The receptions that metrics counted. Nobody is switched off in a flood bench.
Tally tally(const MetricValues& metrics) {
    Tally tally{metrics.receptions, metrics.receptions};
    for (const Fate lost : {Fate::garbled, Fate::collided, Fate::busy}) {
        tally.attempts += metrics.drops[loss_codes.place(reason_of(lost).code)].count;
    }
    return tally;
}

/// Whether frames interfere, or their senders listen: more than the decode range matters.
bool interferes(const FloodBench& bench) {
    return !bench.reception.as<Threshold>() || bench.access.as<Csma>();
}

bool has_levels(const FloodBench& bench) { return bench.shadowing.value > 0 || interferes(bench); }

/// Scenario without robots. Levels fall with the fourth power of the distance, as over flat ground
/// far off.
Scenario scenario_of(const FloodBench& bench) {
    using namespace std::chrono_literals;
    Scenario out;
    out.scenario.seed = bench.seed;
    out.scenario.event_limit = ~std::uint64_t{0};
    out.propagation.model = has_levels(bench) ? PropagationTable::place_of<LogDistance>()
                                              : PropagationTable::place_of<Disc>();
    std::get<LogDistance>(out.propagation.parameters) = {.exponent = 4, .sigma = bench.shadowing};
    std::get<Disc>(out.propagation.parameters).range = {decode_range};
    out.reception = bench.reception;
    out.access = bench.access;
    std::get<Csma>(out.access.parameters).basic_rates = {{{11e6}}};
    std::get<Flood>(out.routing.parameters) = {
        .ttl = 65535, .upgrade = false, .jitter = out.access.as<Csma>() ? 50ms : 10ms};
    if (bench.suppression) {
        out.routing.model = RoutingTable::place_of<Suppression>();
        std::get<Suppression>(out.routing.parameters) = {
            .scheme = *bench.suppression, .range = Meters{decode_range}, .ttl = 65535};
    }
    return out;
}

/// A radio that reaches as far as the bench wants, at the median.
Radio radio(const FloodBench& bench) {
    Radio radio{.rate = {11e6}, .preamble = std::chrono::microseconds{96}};
    // Well above the noise at the decode range, as the reception model "sinr" needs it.
    constexpr Dbm level_at_decode_range{-80};
    if (has_levels(bench)) {
        radio.power = level_at_decode_range + Db{free_space_db(1, radio.frequency)} +
                      Db{40 * math::log10(decode_range)};
    }
    const auto level_at = [&](double d) {
        return radio.power - Db{free_space_db(1, radio.frequency) + 40 * math::log10(d)};
    };
    if (has_levels(bench)) radio.sensitivity = level_at(decode_range);
    if (interferes(bench)) {
        radio.carrier_sense_threshold = level_at(sensing_range);
    }
    return radio;
}

Movement movement(const FloodBench& bench, double side) {
    if (bench.mobility == BenchMobility::fixed) return Fixed{};
    return RandomWaypoint{.area = {{0, 0}, {side, side}}, .min_speed = {1}, .max_speed = {20}};
}

void add_robots(Network& network, const FloodBench& bench, std::uint32_t nodes) {
    const double length = side(nodes);
    const auto coordinate = [&](std::uint32_t node, std::uint64_t axis) {
        return length *
               uniform(
                   {.seed = bench.seed, .purpose = Purpose::placement, .a = node, .index = axis});
    };
    network.reserve(nodes);
    const Movement move = movement(bench, length);  // its copies share the parameters
    for (std::uint32_t i = 0; i < nodes; ++i) {
        network.add({.name = fmt::format("r{}", i),
                     .at = {coordinate(i, 0), coordinate(i, 1)},
                     .radio = radio(bench),
                     .move = move});
    }
}

/// The cost of a plain breadth-first search of the graph of who hears whom now [ns per edge].
double search_cost(Network& network, std::uint32_t nodes) {
    std::vector<std::uint32_t> first{0};
    std::vector<NodeId> neighbours;
    for (std::uint32_t i = 0; i < nodes; ++i) {
        network.find_hearers(NodeId{i}, neighbours);
        first.push_back(static_cast<std::uint32_t>(neighbours.size()));
    }
    std::uint64_t edges = 0;
    const double begin = cpu_seconds();
    double spent = 0;
    for (std::uint32_t round = 0; spent < 0.1; ++round) {
        std::vector<bool> seen(nodes);
        std::vector<std::uint32_t> queue{round % nodes};
        seen[queue[0]] = true;
        for (std::size_t next = 0; next < queue.size(); ++next) {
            for (auto e = first[queue[next]]; e < first[queue[next] + 1]; ++e, ++edges) {
                if (seen[neighbours[e].index()]) continue;
                seen[neighbours[e].index()] = true;
                queue.push_back(neighbours[e].value);
            }
        }
        spent = cpu_seconds() - begin;
    }
    return 1e9 * spent / static_cast<double>(std::max<std::uint64_t>(edges, 1));
}

/// Sends one message and runs until nobody forwards it any more.
void flood(Network& network, NodeId from) {
    network.send(from, everyone, "", {.size = payload});
    for (std::uint64_t before = ~std::uint64_t{0}; before != network.transmissions();) {
        before = network.transmissions();
        network.run_for(std::chrono::milliseconds{100});
    }
}

/// Floods from one robot after another for so long. @return CPU time that it took [s]
double flood_for(Network& network, double cpu_s, std::uint32_t nodes, std::uint32_t& origin) {
    const double begin = cpu_seconds();
    double spent = 0;
    while (spent < cpu_s) {
        origin = static_cast<std::uint32_t>((origin + std::uint64_t{7919}) % nodes);
        flood(network, NodeId{origin});
        spent = cpu_seconds() - begin;
    }
    return spent;
}

}  // namespace

FloodBenchRow flood_bench(const FloodBench& bench, std::uint32_t nodes) {
    if (nodes < 2)
        throw std::invalid_argument(
            "a flood needs at least 2 robots; expected a larger number in --nodes");
    const double before = allocated();
    const Scenario scenario = scenario_of(bench);
    ScenarioRun run(scenario, nullptr, bench.recorded ? Observed::everything : Observed::nothing);
    Network& network = run.session().network();
    const auto count = std::make_shared<Count>();
    if (!bench.recorded) network.add_sink(Sink{count});
    const auto tally_now = [&] {
        return bench.recorded ? tally(network.metrics()) : static_cast<Tally>(*count);
    };
    add_robots(network, bench, nodes);
    network.run_for(Duration{0});

    std::vector<double> costs;  // of the parts [ns per attempt]
    std::uint32_t origin = 0;
    for (int part = 0; part < 5; ++part) {
        const std::uint64_t attempts = tally_now().attempts;
        const double spent = flood_for(network, bench.cpu_s / 5, nodes, origin);
        const std::uint64_t more = std::max<std::uint64_t>(tally_now().attempts - attempts, 1);
        costs.push_back(1e9 * spent / static_cast<double>(more));
    }
    std::sort(costs.begin(), costs.end());
    const Tally all = tally_now();
    const double bytes = (allocated() - before) / nodes;
    return {.nodes = nodes,
            .transmissions = network.transmissions(),
            .receptions = all.decoded,
            .attempts = all.attempts,
            .events = network.events(),
            .ns_per_reception = costs[2],
            .bfs_ns_per_edge = search_cost(network, nodes),
            .bytes_per_node = bytes};
}

}  // namespace rovernet
