// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"
#include "experiment/run.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {

NodeId robot_named(const Network& network, const std::string& name) {
    if (const auto node = network.find(name)) return *node;
    constexpr std::size_t most_listed = 20, most_compared = 1000;
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < network.size() && i < most_compared; ++i) {
        names.push_back(network.name(NodeId{i}));
    }
    const std::string near = did_you_mean(name, names);
    names.resize(std::min(names.size(), most_listed));
    throw std::invalid_argument(fmt::format(
        "there is no robot \"{}\"; expected one of {}{}{}{}", name, fmt::join(names, ", "),
        network.size() > most_listed ? " ..." : "", near.empty() ? "" : "; ", near));
}

std::unique_ptr<Network> network_at(const Scenario& scenario, Time at) {
    auto network = std::make_unique<Network>(network_settings(scenario));
    populate(*network, scenario);
    network->run_until(at);
    return network;
}

LinkReport report_link(const Scenario& scenario, const std::string& from, const std::string& to,
                       Time at) {
    const auto built = network_at(scenario, at);
    const Network& network = *built;
    const NodeId a = robot_named(network, from), b = robot_named(network, to);
    if (a == b) throw std::invalid_argument("a link needs two robots, got \"" + from + "\" twice");

    const Medium& medium = network.medium();
    const Vec3 pa = medium.antenna(a, at, network.legs());
    const Vec3 pb = medium.antenna(b, at, network.legs());
    LinkReport report{.from = from,
                      .to = to,
                      .model = std::string(medium.model(a).name()),
                      .at = at,
                      .distance_m = distance(pa, pb),
                      .walls = network.scene().crossings(pa, pb),
                      .materials = {},
                      .wall_m = network.scene().wall_length(pa, pb),
                      .sender = medium.radio(a),
                      .receiver = medium.radio(b),
                      .path_loss = medium.path_loss(a, b, at, network.legs()),
                      .received = {},
                      .margin = {},
                      .up = false};
    report.received = received_power(report.sender, report.receiver, report.path_loss);
    report.margin = link_budget(report.sender, report.receiver) - report.path_loss;
    report.up = medium.link_up(a, b, at, network.legs());
    for (const Crossing& wall : report.walls) {
        report.materials.push_back(network.scene().materials()[wall.material].name);
    }
    return report;
}

}  // namespace rovernet
