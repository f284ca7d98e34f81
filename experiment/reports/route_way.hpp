// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "sim/routing_protocol.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Current path of messages from one robot to a second robot, according to the robots' routing
/// tables.
struct RouteWay {
    /// Hop of the path, according to the routing table of the robot `from`.
    struct Hop {
        NodeId from, to;
        Duration age;  ///< time since the robot `from` learnt the route [ns]
        bool is_up;    ///< true: the link is up, so that the robot `to` receives frames of `from`
    };
    NodeId from, to;
    std::vector<Hop> hops;
    /// Robot at which the path breaks off. Either this robot has no valid route, or its next hop
    /// does not receive its frames, or its route is a loop. None: the path is complete.
    std::optional<NodeId> broken_at;
    std::string reason;  ///< reason, such as "it has no route to B"; empty if the path does not
                         ///< break off
};

/// Follows the routing tables of the robots from `from` to `to`, hop by hop, or along the path that
/// the first robot knows. Hops after a link that is down are part of the result, too.
RouteWay route_way(const Network& network, NodeId from, NodeId to);

/// Path as a sentence, such as "route from A to B: A > r3 > B, 2 hops, oldest part learnt 2.3 s
/// ago", or "route from A to B breaks off at r3: it has no route to B (A > r3)".
std::string route_way_text(const Network& network, const RouteWay& way);

}  // namespace rovernet
