// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/phy/wifi.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace rovernet {

/// Rule for the EIFS, a waiting time longer than DIFS (it includes time for an acknowledgement)
/// after a frame that a station did not decode.
///
/// - standard: after a frame that the station had locked onto, until a frame without errors ends;
///   802.11-2020, 10.3.2.3.7
/// - ns2: after each sensed frame, decodable or not, unless the station is transmitting; it is a
///   reservation, so a DIFS follows, and no other frame ends it
/// - none: never
enum class EifsRule { standard, ns2, none };
/// Names of the values of [access] eifs in scenario files.
template <>
struct EnumNames<EifsRule> {
    static constexpr std::array<std::string_view, 3> values = {"standard", "ns2", "none"};
};

/// Timing of a standard as in ns-2.35: energy is sensed at once, without turnaround time, and a
/// backoff has 0 to CW - 1 slots.
constexpr WifiTiming ns2_timing(WifiTiming timing) {
    timing.cca_time = timing.turnaround = Duration{0};
    --timing.cw_min;
    --timing.cw_max;
    return timing;
}

/// Settings of the 802.11 DCF. Defaults are those of 802.11b.
/// Example: examples/hidden_node.cpp.
struct Csma {
    static constexpr std::string_view name = "csma";

    /// Standard, which determines airtimes and the default timing.
    WifiStandard standard = WifiStandard::b;
    /// Timing of the access; by default the standard's.
    WifiTiming timing = timing_of(WifiStandard::b);
    /// Basic rates [bit/s]: broadcasts and RTS use the lowest. A response (CTS, ACK) uses the
    /// highest that is not above the rate of the frame it answers, or the lowest if all are above.
    /// Not empty; in any order.
    std::vector<BitRate> basic_rates = mandatory_rates(WifiStandard::b);
    /// Rule for the EIFS, a longer waiting time after a frame that was not decoded.
    EifsRule eifs = EifsRule::standard;
    /// True: a station that finds the medium idle for a DIFS sends without a backoff (802.11-2020,
    /// 10.3.4.2); false: a backoff before every frame, as in ns-2.
    bool immediate_access = true;
    /// Retry limit of an RTS, or of data without RTS; 0: unlimited.
    int short_retries = 7;
    /// Retry limit of data after an RTS; 0: unlimited.
    int long_retries = 4;
    /// Size [bytes], including the header, above which a unicast is preceded by an RTS.
    std::uint32_t rts_threshold = 2347;
    /// Bytes that the access model adds to a message.
    std::uint32_t header = data_header_bytes;
    /// Largest number of frames waiting at a node; further frames are dropped.
    std::uint32_t queue = 50;
    /// True: control packets of the routing protocol are sent before messages of applications, as
    /// in ns-2's CMUPriQueue.
    bool priority = false;

    /// Creates the model for one Network.
    /// @throws std::invalid_argument if the slot is not > 0, or there is no basic rate
    std::unique_ptr<Access> make_access() const;
};

}  // namespace rovernet
