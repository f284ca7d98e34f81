// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/csma.hpp"
#include "study/validation/cases/bianchi.hpp"

#include <cstdint>

namespace rovernet {

/// Theoretical throughput of broadcasts of 1000 bytes by 802.11b stations at 1 Mb/s that are all in
/// range of each other. Broadcasts are neither acknowledged nor repeated, so the contention window
/// stays at 32 slots. The theory neglects that a station whose backoff is 0 sends immediately after
/// its last frame: it is valid for up to about 10 stations.
struct BroadcastCell {
    static constexpr std::uint32_t payload = 1000;  ///< bytes of data in each broadcast
    static constexpr BitRate rate{1e6};

    std::uint32_t header = data_header_bytes;  ///< bytes of the frame's header

    Csma csma() const { return {.eifs = EifsRule::none, .header = header}; }
    /// Share of the time [-] in which payload reaches a station if `n` stations send.
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
