// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace rovernet {

/// A radio's network, as numbers that are equal where the settings are.
struct Membership {
    std::uint32_t essid;    ///< 0: any
    std::uint32_t channel;  ///< its number and its frequency
    bool gated;             ///< has links within its network only

    static bool match(const Membership& a, const Membership& b) {
        return !a.gated || !b.gated ||
               (a.channel == b.channel && (a.essid == b.essid || !a.essid || !b.essid));
    }
};

}  // namespace rovernet
