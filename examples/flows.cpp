// SPDX-License-Identifier: MIT
// Flows: messages that share a number are measured together. Here video and telemetry of one robot
// compete for a slow radio, while it drives away.
#include "rovernet.hpp"

#include <fmt/format.h>

using namespace rovernet;
using namespace std::chrono_literals;

int main() {
    enum Flow : std::uint32_t { video = 1, telemetry = 2 };
    Network net{{.propagation = LogDistance{.exponent = 3},
                 .reception = Sinr{},
                 .access = Csma{.queue = 5},
                 .metric_parts = {.flows = true}}};
    const Radio radio{.rate = BitRate{1e6}};
    const auto base = net.add({.name = "base", .at = {0, 0}, .radio = radio});
    const auto rover = net.add({.name = "rover",
                                .at = {5, 0},
                                .radio = radio,
                                .move = ToGoal{.to = {105, 0}, .speed = {5}}});
    net.every(11ms, [&] { net.send(rover, base, "frame", {.size = 1400, .flow = video}); });
    net.every(100ms, [&] { net.send(rover, base, "state", {.size = 50, .flow = telemetry}); });
    net.run_for(20s);
    const MetricValues metrics = net.metrics();
    for (const Flow flow : {video, telemetry}) {
        const PartValues& of = metrics.flows[flow - 1];
        fmt::print("{:9} {:4} of {:4} delivered, {:5.1f} ms\n",
                   flow == video ? "video" : "telemetry", of.deliveries, of.messages,
                   1e3 * of.latency_mean().value_or(0));
    }
}
