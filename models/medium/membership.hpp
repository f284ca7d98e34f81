// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Networks of radios (essid, channel and frequency); a gate admits only radios of its own network.

namespace rovernet {

/// Network of a radio, as numbers that are equal if the settings are. Comparing numbers is faster
/// than comparing names. RadioKinds assigns the numbers.
struct Membership {
    /// Number of the network's name (essid); 0: any.
    std::uint32_t essid;
    /// Number of the combination of channel and frequency.
    std::uint32_t channel;
    /// True if the radio only has links within its network.
    bool gated;

    /// Whether two radios may have a link: they share a network, or one of them is not gated.
    static bool match(const Membership& a, const Membership& b) {
        return !a.gated || !b.gated ||
               (a.channel == b.channel && (a.essid == b.essid || !a.essid || !b.essid));
    }
};

}  // namespace rovernet
