// SPDX-License-Identifier: MIT
#include "study/validation/cases/validation_scene.hpp"

#include "scenario/document/toml.hpp"
#include "scene/scene.hpp"
#include "study/measurement.hpp"
#include "study/statistics/metric_bounds.hpp"
#include "study/validation/cases/drawn_map.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

constexpr double cave_cell = 0.1;  // [m]

/// What the three scenes share: a flood every two seconds.
constexpr const char* floods = R"(
[routing]
protocol = "flood"
ttl = 4
jitter = "10 ms"

[[traffic]]
from = "r0"
payload = "F"
start = "1 s"
every = "2 s"
)";

constexpr const char* indoors = R"(
duration = "40 s"
seed = 22

[radio]
power = "0 dBm"
sensitivity = "-72 dBm"

[propagation]                         # as given: what a user would write who has not fitted
model = "raytrace_2007"
coefficient = 20
wall_factor = 0.3
sigma = "0 dB"

[[robot]]
name = "r"
count = 8
radius = "0.2 m"
move = { model = "random_waypoint" }
)";

std::optional<double> metric(const Measurement& measurement, std::string_view name) {
    for (const MetricValue& each : measurement.metrics) {
        if (each.name == name) return each.value;
    }
    return std::nullopt;
}

TurnCost cost_of(std::vector<double> seen) {
    std::sort(seen.begin(), seen.end());
    return {seen[seen.size() / 2], seen.front(), seen.back()};
}

}  // namespace

Scenario ValidationScene::scenario(const Table& settings, std::uint32_t replication) const {
    Value document = parse_toml(text, name);
    for (const Entry& table : settings.entries) {
        for (const Entry& entry : table.value.table()->entries) {
            set_value(document, table.key + "." + entry.key, entry.value, {name, 0, 0});
        }
    }
    Scenario out = read_scenario(document, name);
    out.walls = walls ? walls : std::make_shared<const Scene>();
    out.scenario.replication = replication;
    return out;
}

ValidationScene open_field_scene() {
    return {.name = "open field", .text = std::string(R"([scenario]
name = "field"
duration = "40 s"
seed = 22

[radio]
power = "10 dBm"
sensitivity = "-82 dBm"
antenna_height = "1 m"

[propagation]
model = "two_ray"
sigma = "0 dB"

[[robot]]
name = "r"
count = 20
move = { model = "random_waypoint", area = [["0 m", "0 m"], ["900 m", "900 m"]], max_speed = "5 m/s" }
)") + floods};
}

ValidationScene office_scene() {
    const DrawnBuilding office = drawn_office();
    return {.name = "office",
            .text = std::string("[scenario]\nname = \"office\"") + indoors + floods,
            .walls = std::make_shared<const Scene>(
                drawn_map(office.width, office.depth, office_cell.value,
                          [&](Vec3 p) { return office.is_wall(p); }))};
}

ValidationScene cave_scene() {
    return {.name = "cave",
            .text = std::string("[scenario]\nname = \"cave\"") + indoors + floods,
            .walls = std::make_shared<const Scene>(
                drawn_map(cave_width, cave_depth, cave_cell, is_rock))};
}

std::vector<VariantRuns> paired_runs(const ValidationScene& scene,
                                     const std::vector<Variant>& variants,
                                     std::size_t replications) {
    KeptPlanners kept;
    std::vector<VariantRuns> out(variants.size());
    std::vector<std::vector<double>> costs(variants.size());
    for (std::uint32_t r = 0; r < replications; ++r) {
        for (std::size_t i = 0; i < variants.size(); ++i) {
            const Measurement run = measure(scene.scenario(variants[i].settings, r), kept);
            out[i].delivery_ratio.push_back(metric(run, "delivery_ratio").value_or(0));
            const double sent = std::max(metric(run, "transmissions").value_or(1), 1.0);
            costs[i].push_back(1e9 * run.cpu_s / sent);
        }
    }
    for (std::size_t i = 0; i < variants.size(); ++i) out[i].cost = cost_of(costs[i]);
    return out;
}

RunErrors run_errors(const VariantRuns& runs, const VariantRuns& truth) {
    RunErrors out;
    const auto n = static_cast<double>(runs.delivery_ratio.size());
    for (std::size_t r = 0; r < runs.delivery_ratio.size(); ++r) {
        const double difference = runs.delivery_ratio[r] - truth.delivery_ratio[r];
        out.distances.push_back(std::abs(difference));
        out.mean += out.distances.back() / n;
        out.bias += difference / n;
    }
    if (out.mean > 0) out.likely = interval_of(out.distances, bounds_of("delivery_ratio"));
    return out;
}

}  // namespace rovernet
