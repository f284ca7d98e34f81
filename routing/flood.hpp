// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/router.hpp"

#include <string_view>

namespace rovernet {

/// Treatment of the copies of a message that a node receives after the first one.
enum class Duplicates { suppress, forward };

/// Names of the values of `duplicates` in scenario files.
template <>
struct EnumNames<Duplicates> {
    static constexpr std::array<std::string_view, 2> values = {"suppress", "forward"};
};

/// Flooding with a time-to-live: a message leaves its source with TTL k and travels at most k hops.
/// A receiver decrements the TTL and forwards the copy if the result is > 0, after 1 us + U(0,
/// jitter).
///
/// "suppress": each node forwards a message once. With `upgrade`, a later copy with a higher TTL
/// raises the TTL of the waiting copy, or is forwarded if the first copy was not, so that a long
/// path heard first does not shorten the flood. "forward": every copy is forwarded, also by its
/// source, and only the TTL limits the flood. This is the rule of the 2007 thesis
/// (docs/formats/worlds.md), whose load grows with the number of walks in the network.
struct Flood {
    static constexpr std::string_view name = "flood";

    int ttl = 3;  ///< initial TTL of a message [hops], 1 ... 65535
    Duplicates duplicates = Duplicates::suppress;
    bool upgrade = true;  ///< a later copy's higher TTL raises the waiting copy's TTL
    Duration jitter = std::chrono::milliseconds{10};  ///< longest random forwarding delay [ns]
    bool ttl_in_payload = false;  ///< first byte of a payload: the message's TTL; 0 counts as 1

    static constexpr auto fields() {
        return describe(
            field("ttl", &Flood::ttl, Range{.low = 1, .high = 65535, .text = "from 1 to 65535"},
                  "number of hops that a message may cross (time-to-live, TTL)"),
            field("duplicates", &Flood::duplicates,
                  "what a robot does with a further copy of a message. suppress: does not forward "
                  "it; forward: forwards it, too"),
            field("upgrade", &Flood::upgrade,
                  "for suppress: a further copy with a higher TTL raises the TTL of the first "
                  "copy, if the first copy still waits to be forwarded"),
            field("jitter", &Flood::jitter, Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "upper limit of the uniform random delay before a robot forwards a message"),
            field("ttl_in_payload", &Flood::ttl_in_payload,
                  "true: the first byte of the payload of a message is its TTL, as in the 2007 "
                  "thesis on a wifi model for Stage"));
    }

    operator Router() const;
};

}  // namespace rovernet
