// SPDX-License-Identifier: MIT
#include "cli/tools/tool_commands.hpp"
#include "experiment/version.hpp"
#include "scenario/document/json.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace rovernet::cli {
namespace {

/// Place of `word` among `names`. @throws std::invalid_argument
std::size_t choice(const char* option, const std::string& word, const auto& names) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
        throw std::invalid_argument(fmt::format("--{}: found \"{}\"; expected one of {}", option,
                                                word, fmt::join(names, ", ")));
    }
    return static_cast<std::size_t>(found - names.begin());
}

/// The processor's name, where the system tells it.
std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

Table as_table(const FloodBenchRow& row) {
    Table table;
    table.set("nodes", std::uint64_t{row.nodes});
    table.set("transmissions", row.transmissions);
    table.set("receptions", row.receptions);
    table.set("ns_per_reception", row.ns_per_reception);
    table.set("bfs_ns_per_edge", row.bfs_ns_per_edge);
    table.set("bytes_per_node", row.bytes_per_node);
    return table;
}

void print_row(const FloodBenchRow& r) {
    fmt::print("{:>9} {:>13} {:>12} {:>16.1f} {:>15.2f} {:>14.0f}\n", r.nodes, r.transmissions,
               r.receptions, r.ns_per_reception, r.bfs_ns_per_edge, r.bytes_per_node);
    std::fflush(stdout);
}

}  // namespace

void bench_flood(const BenchArguments& a) {
    FloodBench bench = a.bench;
    bench.reception.model = choice("reception", a.reception, ReceptionTable::names());
    bench.access.model = choice("access", a.access, AccessTable::names());
    bench.mobility = static_cast<BenchMobility>(
        choice("mobility", a.mobility, EnumNames<BenchMobility>::values));
    std::vector<std::string_view> schemes{"none"};
    for (const std::string_view each : EnumNames<SuppressionScheme>::values)
        schemes.push_back(each);
    if (const std::size_t place = choice("suppression", a.suppression, schemes); place > 0)
        bench.suppression = static_cast<SuppressionScheme>(place - 1);
    Array rows;
    if (!a.json) {
        fmt::print("{:>9} {:>13} {:>12} {:>16} {:>15} {:>14}\n", "nodes", "transmissions",
                   "receptions", "ns/reception", "bfs ns/edge", "bytes/node");
    }
    for (const std::uint32_t nodes : bench.nodes) {
        const FloodBenchRow row = flood_bench(bench, nodes);
        if (a.json)
            rows.emplace_back(as_table(row));
        else
            print_row(row);
    }
    if (!a.json) return;
    Table table;
    table.set("rows", std::move(rows));
    table.set("build", version());
    table.set("cpu", processor());
    fmt::print("{}\n", to_json(table));
}

}  // namespace rovernet::cli
