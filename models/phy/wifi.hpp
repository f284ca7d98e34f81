// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/phy.hpp"
#include "sim/fields.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

// Timing and airtimes of IEEE 802.11: constants that access model "csma" and the physical layer
// Wifi take from the standard.

namespace rovernet {

/// Physical layer of IEEE 802.11 whose timing the channel access follows.
enum class WifiStandard {
    /// 802.11b: DSSS and HR/DSSS, 1-11 Mb/s.
    b,
    /// 802.11a: OFDM, 6-54 Mb/s.
    a,
    /// 802.11g among its own: ERP-OFDM with the short slot.
    g,
};
/// Words of [access] standard.
template <>
struct EnumNames<WifiStandard> {
    static constexpr std::array<std::string_view, 3> values = {"802.11b", "802.11a", "802.11g"};
};

/// Times of an 802.11 channel access, all of them [ns], and what goes with them.
struct WifiTiming {
    /// Slot of a backoff: aSlotTime.
    Duration slot;
    /// Space before an answer: aSIFSTime.
    Duration sifs;
    /// Space before access: aSIFSTime + 2 aSlotTime; 802.11-2020, 10.3.7.
    Duration difs;
    /// Time until energy that has arrived is sensed.
    Duration cca_time;
    /// Time from deciding to send to sending: aRxTxTurnaroundTime.
    Duration turnaround;
    /// Time until it is noticed that a frame begins: aRxPHYStartDelay.
    Duration rx_start_delay;
    /// Least contention window [slots]: aCWmin.
    int cw_min;
    /// Largest contention window [slots]: aCWmax.
    int cw_max;
    /// Rate [bit/s] that every station has: that of the ACK that an EIFS has room for.
    BitRate lowest_rate;
};

/// Constants of a standard, by clauses of IEEE 802.11-2020. The CCA times are what a slot leaves
/// beside the turnaround and 2 us for the air (the standard gives an upper bound only).
constexpr WifiTiming timing_of(WifiStandard standard) {
    using namespace std::chrono_literals;
    switch (standard) {
        case WifiStandard::b:  // 15.3.3 and 16.3.3: DSSS PHY characteristics
            return {20us, 10us, 50us, 13us, 5us, 192us, 31, 1023, {1e6}};
        case WifiStandard::a:  // 17.4.4: OFDM PHY characteristics, 20 MHz
            return {9us, 16us, 34us, 5us, 2us, 20us, 15, 1023, {6e6}};
        case WifiStandard::g:  // 18.4.4: ERP characteristics, short slot
            return {9us, 10us, 28us, 5us, 2us, 20us, 15, 1023, {6e6}};
    }
    return {};
}

/// Bit rates that every station of a standard has, lowest first. They are the basic rates of csma
/// by default.
///
/// Sources: 802.11-2020, 16.1.1, 17.1.1 and, for 802.11g among its own, 18.1.2.
inline std::vector<BitRate> mandatory_rates(WifiStandard standard) {
    if (standard == WifiStandard::b) return {{1e6}, {2e6}, {5.5e6}, {11e6}};
    return {{6e6}, {12e6}, {24e6}};
}

/// Rates of a standard [bit/s], mandatory or not: 1 to 11 Mb/s of 802.11b, 6 to 54 Mb/s of 802.11a,
/// all of them of 802.11g.
std::span<const BitRate> rates_of(WifiStandard standard);

/// Time on air [ns] of `bytes` [bytes] behind a preamble: for 802.11b in whole microseconds, as its
/// length field counts (802.11-2020, 15.2.3.5, 16.2.3.5); for OFDM in whole symbols of 4 us behind
/// the service and before the tail bits (17.4.3), with 6 us of signal extension for 802.11g
/// (18.5.3).
///
///   1500 bytes   802.11b, 11 Mb/s, 192 us of preamble   1283 us
///                802.11a, 54 Mb/s, 20 us of preamble     244 us
Duration wifi_airtime(WifiStandard standard, Duration preamble, BitRate rate, std::uint32_t bytes);

/// Physical layer "wifi": IEEE 802.11b, a and g. Error rates: models/phy/error_rate.hpp; the coding
/// is the Modulation.
///
/// Without a framing it is the plain radio of access models "none" and "aloha": 64 bytes at 11 Mb/s
/// behind the long preamble are 192 us + 46.545 us on air.
struct Wifi {
    static constexpr std::string_view name = "wifi";

    /// Standard by which frames last as wifi_airtime() says; none: the preamble and bits / rate,
    /// rounded to the nearest nanosecond.
    std::optional<WifiStandard> framing = std::nullopt;

    static constexpr auto fields() {
        return describe(field("framing", &Wifi::framing,
                              "standard whose symbols and fields frames are made of; without one "
                              "they last as long as their bits"));
    }

    /// Functions of a physical layer, see PhysicalLayer.
    Duration airtime(Duration preamble, BitRate rate, std::uint32_t bytes) const;
    std::span<const BitRate> rates() const;
    std::optional<Coding> coding(BitRate rate) const;
    double log_success(Coding coding, double sinr) const;
    Db certain_sinr(Coding coding) const;
};

/// Sizes of control frames [bytes], check sequence included; 802.11-2020, 9.3.1.
inline constexpr std::uint32_t rts_bytes = 20;
inline constexpr std::uint32_t cts_bytes = 14;
inline constexpr std::uint32_t ack_bytes = 14;
/// Size that a data frame has beside its message: 24 bytes of header, 4 of check sequence.
inline constexpr std::uint32_t data_header_bytes = 28;

}  // namespace rovernet
