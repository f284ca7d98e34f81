// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/csma.hpp"
#include "study/validation/cases/bianchi.hpp"

#include <cstdint>

namespace rovernet {

/// A cell of 802.11b at 1 Mb/s in which all send broadcasts of 1000 bytes: nothing is answered or
/// repeated, the window stays at 32 slots. A station whose draw is 0 sends at once behind its last
/// frame, which the theory leaves out: it holds up to some 10 stations.
struct BroadcastCell {
    static constexpr std::uint32_t payload = 1000;  ///< [bytes]
    static constexpr BitRate rate{1e6};

    std::uint32_t header = data_header_bytes;  ///< [bytes]

    Csma csma() const { return {.eifs = EifsRule::none, .header = header}; }
    /// Share of the time in which payload reaches a station, of `n` that send.
    double throughput(int n) const {
        constexpr double preamble = 192, difs = 50;
        const double busy = preamble + 8 * (payload + header) + difs;
        const Bianchi cell{.window = 32,
                           .stages = 0,
                           .slot = 20,
                           .payload = 8 * payload,
                           .success = busy,
                           .collision = busy};
        return cell.throughput(n, 2.0 / (cell.window + 1));
    }
};

}  // namespace rovernet
