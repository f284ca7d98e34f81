// SPDX-License-Identifier: MIT
#include "experiment/reports/link_pairs.hpp"

#include "experiment/reports/range_of_model.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "network/network.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace rovernet {
namespace {

/// Strength of the link from `from` to `to`; none if `to` cannot hear.
std::optional<LinkStrength> strength(const Network& network, NodeId from, NodeId to, Time at) {
    const Stations& stations = network.medium().stations();
    const LinkLosses& links = network.medium().links();
    const Legs& legs = network.legs();
    const Radio& sender = stations.radio(from);
    const Db budget = link_budget(sender, stations.radio(to));
    constexpr double slack = 1 + 1e-9;  // rounding of the model's inverse
    const double d = distance(stations.antenna(from, at, legs), stations.antenna(to, at, legs));
    if (d > slack * stations.model(from).reach(budget, sender.frequency).value) return {};
    if (!links.is_up(from, to, at, legs)) return {};
    return LinkStrength{.level = links.level(from, to, at, legs),
                        .margin = links.margin(from, to, at, legs),
                        .has_level = !range_of(stations.model(from))};
}

}  // namespace

std::vector<LinkPair> link_pairs(const Network& network, Time at,
                                 const std::function<bool(NodeId)>& at_one_end) {
    const auto robots = static_cast<std::uint32_t>(network.size());
    std::vector<bool> is_wanted(robots);
    std::vector<NodeId> wanted;
    for (NodeId node{0}; node.value < robots; ++node.value) {
        if (!at_one_end(node)) continue;
        is_wanted[node.index()] = true;
        wanted.push_back(node);
    }
    if (wanted.size() * robots > std::size_t{most_linked} * most_linked) {
        throw RunError(
            fmt::format("links of {} robots are too many for a picture; expected at most {} robots",
                        robots, most_linked));
    }
    std::vector<LinkPair> pairs;
    for (const NodeId one : wanted) {
        for (NodeId other{0}; other.value < robots; ++other.value) {
            if (other == one || (is_wanted[other.index()] && other < one)) continue;
            const auto [a, b] = std::minmax(one, other);
            const auto there = strength(network, a, b, at), back = strength(network, b, a, at);
            if (there) {
                pairs.push_back({a, b, *there, back});
            } else if (back) {
                pairs.push_back({b, a, *back, {}});
            }
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const LinkPair& x, const LinkPair& y) {
        return std::minmax(x.from, x.to) < std::minmax(y.from, y.to);
    });
    return pairs;
}

}  // namespace rovernet
