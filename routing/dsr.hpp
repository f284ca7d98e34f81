// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <string_view>

namespace rovernet {

/// Variant of DSR: the text of RFC 4728, or the implementation in ns-2.35
/// (docs/methods/routing.md).
enum class DsrProfile { rfc, ns2 };

/// Names of the values of `profile` in scenario files.
template <>
struct EnumNames<DsrProfile> {
    static constexpr std::array<std::string_view, 2> values = {"rfc", "ns2"};
};

/// Dynamic source routing of messages to one robot (RFC 4728). A node without a route floods a
/// request, which collects the nodes on its path. The target answers with the collected path; so
/// does a node that knows a route to the target, with this route appended. Every message carries
/// its whole route, so that nodes on the way need no tables. A node that cannot reach the next hop
/// reports the broken link to the message's source, and sends the message along another route if
/// the node knows one (salvaging).
///
/// Nodes store the routes that they see in packets. A route has sixteen nodes at most. Messages to
/// everyone go over one hop. A robot that was switched off starts again without routes.
struct Dsr {
    static constexpr std::string_view name = "dsr";

    /// Variant of DSR.
    DsrProfile profile = DsrProfile::rfc;
    /// Whether nodes overhear packets for other nodes, learn routes from these packets, and report
    /// shorter routes.
    bool promiscuous = true;
    /// Number of times that nodes on the way may send a message along another route; 0: never.
    int salvage = 15;
    /// Largest number of packets that wait at a node for routes, each for at most 30 s.
    int buffer = 64;
    /// Longest random delay before a request is forwarded, or answered by its target [ns].
    Duration jitter = std::chrono::milliseconds{10};

    static constexpr auto fields() {
        return describe(
            field("profile", &Dsr::profile,
                  "variant of the protocol. rfc: as in the text of RFC 4728; ns2: as in ns-2.35"),
            field("promiscuous", &Dsr::promiscuous,
                  "true: robots also learn routes and broken links from packets to other robots"),
            field("salvage", &Dsr::salvage, Range{.low = 0, .high = 15, .text = "from 0 to 15"},
                  "largest number of times that a message may be salvaged (sent along a different "
                  "route after a broken link)"),
            field("buffer", &Dsr::buffer, Range{.low = 1, .high = 1e6, .text = "from 1 to 1e6"},
                  "largest number of messages that wait for routes at a robot"),
            field("jitter", &Dsr::jitter, Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper limit of the uniform random delay before a robot forwards or answers a "
                  "request"));
    }

    operator Router() const;
};

}  // namespace rovernet
