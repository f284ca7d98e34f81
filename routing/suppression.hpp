// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <string_view>

namespace rovernet {

/// Rule by which a node suppresses a message (does not forward it), see Suppression.
enum class SuppressionScheme { counter, probability, distance, location, cluster };

/// Names of the values of `scheme` in scenario files.
template <>
struct EnumNames<SuppressionScheme> {
    static constexpr std::array<std::string_view, 5> values = {"counter", "probability", "distance",
                                                               "location", "cluster"};
};

/// Flooding in which a node does not forward a message if forwarding would reach few new nodes. A
/// node that hears a message for the first time waits for 1 us + U(0, delay). The node then
/// forwards the message once, unless the scheme's condition to suppress the message was met during
/// the wait:
///
/// - "counter": the node heard C copies, the first one included.
/// - "probability": with probability 1 - P, drawn at the first copy.
/// - "distance": one of the senders heard is nearer than D.
/// - "location": the discs of radius `range` around the senders heard leave less than the share A
///   of the node's own disc uncovered.
/// - "cluster": the node is neither the head of a cluster nor a gateway between clusters, which
///   nodes agree on by HELLO packets (ClusterRouter).
///
/// The delay should be many times a frame's time on air, because only a copy that waits for its
/// send time can be suppressed, not a copy in the queue of the MAC. Messages to one robot go over
/// one hop. Source: S.-Y. Ni, Y.-C. Tseng, Y.-S. Chen, J.-P. Sheu, The broadcast storm problem in a
/// mobile ad hoc network, MobiCom 1999, section 3.
struct Suppression {
    static constexpr std::string_view name = "suppression";

    SuppressionScheme scheme = SuppressionScheme::counter;
    /// Threshold of the scheme: C [copies], default 3; P [-], default 0.7; D [m], default 40; or A
    /// [-], default 0.05. Not used by "cluster".
    std::optional<double> threshold = std::nullopt;
    /// Radius of the discs of scheme "location" [m]: the range of the radios; no default.
    std::optional<Meters> range = std::nullopt;
    /// Mean time between HELLO packets of a node [ns], for scheme "cluster".
    Duration hello = std::chrono::seconds{1};
    /// Longest random delay [ns] before a node forwards a message, in which it hears further
    /// copies.
    Duration delay = std::chrono::milliseconds{100};
    int ttl = 255;  ///< initial TTL of a message [hops], 1 ... 65535

    static constexpr auto fields() {
        return describe(
            field("scheme", &Suppression::scheme,
                  "rule by which a robot decides not to forward a message: counter, probability, "
                  "distance, location or cluster"),
            field("threshold", &Suppression::threshold, non_negative,
                  "threshold of the scheme. counter: number of copies; probability: probability of "
                  "forwarding; distance: distance in metres; location: share of the disc of radius "
                  "`range`; not for cluster"),
            field("range", &Suppression::range, positive, "for location: range of the radios"),
            field("hello", &Suppression::hello,
                  Range{.low = 0, .high = 1e4, .text = "from 0 to 10000 s"},
                  "for cluster: time between HELLO packets, > 0 s"),
            field("delay", &Suppression::delay,
                  Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper limit of the uniform random time for which a robot waits for further "
                  "copies before it forwards a message"),
            field("ttl", &Suppression::ttl,
                  Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                  "number of hops that a message may cross"));
    }

    operator Router() const;
};

}  // namespace rovernet
