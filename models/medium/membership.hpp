// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

// Networks of radios (essid, channel and frequency), of which a gate lets in its own only.

namespace rovernet {

/// Network of a radio, as numbers that are equal where the settings are. Comparing them costs less
/// than comparing names. RadioKinds gives the numbers.
struct Membership {
    /// Number of its essid; 0: any.
    std::uint32_t essid;
    /// Number of its channel and its frequency, together.
    std::uint32_t channel;
    /// It has links within its network only.
    bool gated;

    /// Whether two radios may have a link: the gate of one is open, or they share a network. The
    /// gate of one alone keeps nobody out.
    static bool match(const Membership& a, const Membership& b) {
        return !a.gated || !b.gated ||
               (a.channel == b.channel && (a.essid == b.essid || !a.essid || !b.essid));
    }
};

}  // namespace rovernet
