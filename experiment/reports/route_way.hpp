// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/routing_protocol.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Way that messages from one robot to another take now, by the robots' routing tables.
struct RouteWay {
    /// Hop of the way, by a route of `from`.
    struct Hop {
        NodeId from, to;
        Duration age;  ///< time since `from` learnt its route [ns]
        bool is_up;    ///< whether `to` hears `from` now
    };
    NodeId from, to;
    std::vector<Hop> hops;
    /// Robot at which the way breaks off: it has no route, or is not heard by its next hop; none if
    /// the way leads to its end.
    std::optional<NodeId> broken_at;
    std::string reason;  ///< why the way breaks off: "it has no route to B"; empty if it does not
};

/// Follows the routes from `from` to `to` through the tables of the robots, hop by hop, or along
/// the path that the first robot knows. Hops after a link that is down are part of the way, too.
RouteWay route_way(const Network& network, NodeId from, NodeId to);

/// Way as a sentence: "route from A to B: A > r3 > B, 2 hops, learnt up to 2.3 s ago", or "route
/// from A to B breaks off at r3: it has no route to B (A > r3)".
std::string route_way_text(const Network& network, const RouteWay& way);

}  // namespace rovernet
