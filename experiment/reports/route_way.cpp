// SPDX-License-Identifier: MIT
#include "experiment/reports/route_way.hpp"

#include "models/medium/medium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rovernet {
namespace {

/// Route of a robot that its messages to `to` would take: a valid one, the shortest first; or else
/// a broken one.
std::optional<RouteState> best_route(const Network& network, NodeId at, NodeId to) {
    std::optional<RouteState> best;
    for (RouteState& each : network.routes(at)) {
        if (each.destination != to) continue;
        const bool is_better = !best || (each.is_valid && !best->is_valid) ||
                               (each.is_valid == best->is_valid && each.hops < best->hops);
        if (is_better) best = std::move(each);
    }
    return best;
}

/// Follows routes, and notes where they break off.
class Follower {
  public:
    Follower(const Network& network, NodeId from, NodeId to)
        : network_(network),
          way_{.from = from, .to = to, .hops = {}, .broken_at = {}, .reason = {}} {}

    RouteWay follow() {
        NodeId at = way_.from;
        while (at != way_.to) {
            const auto route = best_route(network_, at, way_.to);
            if (!route || !route->is_valid || route->next_hop == everyone) {
                const std::string end = network_.name(way_.to);
                break_off(at, route ? fmt::format("the route of this robot to {} is broken", end)
                                    : fmt::format("this robot has no route to {}", end));
                break;
            }
            if (!route->path.empty()) {  // of the first robot: packets carry the path
                for (const NodeId next : route->path) add(std::exchange(at, next), next, *route);
                break;
            }
            add(at, route->next_hop, *route);
            at = route->next_hop;
            if (has_left(at)) {
                break_off(at, "the route leads back to this robot");
                break;
            }
        }
        return std::move(way_);
    }

  private:
    void add(NodeId from, NodeId to, const RouteState& route) {
        const Time now = network_.now();
        const bool is_up = network_.medium().links().is_up(from, to, now, network_.legs());
        way_.hops.push_back({from, to, now - route.since, is_up});
        if (is_up) return;
        const bool is_on = network_.robot(to).presence == Presence::on;
        break_off(from, network_.name(to) + (is_on ? " does not hear this robot" : " is off"));
    }
    /// The first place is the one that counts.
    void break_off(NodeId at, std::string reason) {
        if (way_.broken_at) return;
        way_.broken_at = at;
        way_.reason = std::move(reason);
    }
    bool has_left(NodeId node) const {
        return std::ranges::any_of(way_.hops,
                                   [&](const RouteWay::Hop& hop) { return hop.from == node; });
    }

    const Network& network_;
    RouteWay way_;
};

}  // namespace

RouteWay route_way(const Network& network, NodeId from, NodeId to) {
    return Follower(network, from, to).follow();
}

std::string route_way_text(const Network& network, const RouteWay& way) {
    const std::string text =
        fmt::format("route from {} to {}", network.name(way.from), network.name(way.to));
    std::string robots = network.name(way.from);
    Duration oldest{0};
    for (const RouteWay::Hop& hop : way.hops) {
        robots += " > " + network.name(hop.to);
        oldest = std::max(oldest, hop.age);
    }
    if (way.broken_at) {
        return fmt::format("{} breaks off at {}: {}{}", text, network.name(*way.broken_at),
                           way.reason, way.hops.empty() ? "" : fmt::format(" ({})", robots));
    }
    return fmt::format("{}: {}, {} hop{}, oldest hop learnt {:.3g} s ago", text, robots,
                       way.hops.size(), way.hops.size() == 1 ? "" : "s", seconds(oldest));
}

}  // namespace rovernet
