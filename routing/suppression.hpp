// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace rovernet {

/// Rule by which a node does not forward a message, see Suppression.
enum class SuppressionScheme { counter, probability, distance, location, cluster };

template <>
struct EnumNames<SuppressionScheme> {
    static constexpr std::array<std::string_view, 5> values = {"counter", "probability", "distance",
                                                               "location", "cluster"};
};

/// Flooding in which nodes do not forward a message if that would reach few new nodes. A node that
/// hears a message for the first time waits for 1 us + U(0, delay), and forwards the message once
/// unless its scheme suppresses that meanwhile:
///
/// - "counter": C copies were heard, the first one included.
/// - "probability": with probability 1 - P, drawn at the first copy.
/// - "distance": one of the senders heard is nearer than D.
/// - "location": the discs of `range` around the senders heard leave less than the share A of the
///   node's own disc uncovered.
/// - "cluster": it is neither the head of a cluster nor a gateway between clusters, which nodes
///   agree on by HELLO packets (ClusterRouter).
///
/// The delay should be many times a frame's time on air, as only a copy that waits for its send
/// time can be suppressed, not one in the queue of the MAC. Messages to one robot go over one hop.
/// Source: S.-Y. Ni, Y.-C. Tseng, Y.-S. Chen, J.-P. Sheu, The broadcast storm problem in a mobile
/// ad hoc network, MobiCom 1999, section 3.
struct Suppression {
    static constexpr std::string_view name = "suppression";

    SuppressionScheme scheme = SuppressionScheme::counter;
    /// C [copies], 3 if not given; P [-], 0.7; D [m], 40; or A [-], 0.05: see `scheme`.
    std::optional<double> threshold = std::nullopt;
    /// Radius of the discs of "location" [m], which has no default: the range of the radios.
    std::optional<Meters> range = std::nullopt;
    /// Time between HELLO packets of a node with "cluster" [ns].
    Duration hello = std::chrono::seconds{1};
    /// Longest assessment delay [ns].
    Duration delay = std::chrono::milliseconds{100};
    int ttl = 255;  ///< initial TTL of a message [hops], 1 ... 65535

    static constexpr auto fields() {
        return describe(
            field("scheme", &Suppression::scheme, "what keeps a node from forwarding a message"),
            field("threshold", &Suppression::threshold, non_negative,
                  "copies, probability, distance in metres, or share of the disc: by the scheme"),
            field("range", &Suppression::range, positive,
                  "of the radios, for the scheme \"location\""),
            field(
                "hello", &Suppression::hello,
                Range{.low = 0, .high = 1e4, .low_included = false, .text = "> 0 s, up to 10000 s"},
                "time between HELLO packets, for the scheme \"cluster\""),
            field("delay", &Suppression::delay,
                  Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper end of the uniform delay in which a node hears further copies"),
            field("ttl", &Suppression::ttl,
                  Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                  "hops that a message may cross"));
    }

    operator Router() const;
};

}  // namespace rovernet
