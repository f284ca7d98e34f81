// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Networks of radios (essid, channel and frequency); a radio with a gate only has links with radios
// of its own network.

namespace rovernet {

/// Network of a radio, as numbers: equal numbers stand for equal settings. Comparing numbers is
/// faster than comparing names. RadioKinds assigns the numbers.
struct Membership {
    /// Number that stands for the network's name (essid); 0: "any", which matches every name.
    std::uint32_t essid;
    /// Number that stands for the radio's pair of channel and frequency.
    std::uint32_t channel;
    /// True if the radio has a gate. Two radios with gates need the same network for a link.
    bool gated;

    /// Whether two radios may have a link: they share a network, or one of them has no gate.
    static bool match(const Membership& a, const Membership& b) {
        return !a.gated || !b.gated ||
               (a.channel == b.channel && (a.essid == b.essid || !a.essid || !b.essid));
    }
};

}  // namespace rovernet
