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

// Timing and airtimes of IEEE 802.11: constants of the standard, for access model "csma" and the
// physical layer Wifi.

namespace rovernet {

/// Physical layer standard of IEEE 802.11, which determines timing and airtimes.
enum class WifiStandard {
    /// 802.11b: DSSS and HR/DSSS, 1-11 Mb/s.
    b,
    /// 802.11a: OFDM, 6-54 Mb/s.
    a,
    /// 802.11g without 802.11b stations: ERP-OFDM with the short slot time.
    g,
};
/// Names of the values of [access] standard in scenario files.
template <>
struct EnumNames<WifiStandard> {
    static constexpr std::array<std::string_view, 3> values = {"802.11b", "802.11a", "802.11g"};
};

/// Constants of 802.11 channel access: times [ns], contention windows and lowest bit rate.
struct WifiTiming {
    /// Backoff slot [ns]: aSlotTime.
    Duration slot;
    /// Interframe space [ns] before a response: aSIFSTime.
    Duration sifs;
    /// Interframe space [ns] before channel access: aSIFSTime + 2 aSlotTime; 802.11-2020, 10.3.7.
    Duration difs;
    /// Time [ns] from the arrival of a signal until the station senses that the medium is busy
    /// (CCA).
    Duration cca_time;
    /// Time [ns] from the decision to send to the start of transmission: aRxTxTurnaroundTime.
    Duration turnaround;
    /// Time [ns] until a receiver detects the start of a frame: aRxPHYStartDelay.
    Duration rx_start_delay;
    /// Smallest contention window [slots]: aCWmin.
    int cw_min;
    /// Largest contention window [slots]: aCWmax.
    int cw_max;
    /// Lowest mandatory bit rate [bit/s]; the EIFS includes the airtime of an ACK at this rate.
    BitRate lowest_rate;
};

/// Timing constants of a standard, by clauses of IEEE 802.11-2020. The CCA time is the slot less
/// the turnaround time and 2 us of propagation delay (the standard gives only an upper bound).
constexpr WifiTiming timing_of(WifiStandard standard) {
    using namespace std::chrono_literals;
    switch (standard) {
        case WifiStandard::b:  // 802.11-2020, 15.3.3 and 16.3.3: DSSS PHY characteristics
            return {20us, 10us, 50us, 13us, 5us, 192us, 31, 1023, {1e6}};
        case WifiStandard::a:  // 802.11-2020, 17.4.4: OFDM PHY characteristics, 20 MHz
            return {9us, 16us, 34us, 5us, 2us, 20us, 15, 1023, {6e6}};
        case WifiStandard::g:  // 802.11-2020, 18.4.4: ERP characteristics, short slot
            return {9us, 10us, 28us, 5us, 2us, 20us, 15, 1023, {6e6}};
    }
    return {};
}

/// Mandatory bit rates [bit/s] of a standard, lowest first: the default basic rates of "csma".
///
/// Sources: 802.11-2020, 16.1.1, 17.1.1 and, for 802.11g without 802.11b stations, 18.1.2.
inline std::vector<BitRate> mandatory_rates(WifiStandard standard) {
    if (standard == WifiStandard::b) return {{1e6}, {2e6}, {5.5e6}, {11e6}};
    return {{6e6}, {12e6}, {24e6}};
}

/// Bit rates of a standard [bit/s], mandatory and optional: 1 to 11 Mb/s for 802.11b, 6 to 54 Mb/s
/// for 802.11a, all of these for 802.11g.
std::span<const BitRate> rates_of(WifiStandard standard);

/// Time on air [ns] of a frame: its preamble, then `bytes` bytes at `rate`. For 802.11b in whole
/// microseconds, the unit of the length field (802.11-2020, 15.2.3.5, 16.2.3.5); for OFDM in whole
/// symbols of 4 us, with service and tail bits (802.11-2020, 17.4.3), plus 6 us of signal extension
/// for 802.11g (802.11-2020, 18.5.3).
///
///   1500 bytes   802.11b, 11 Mb/s, 192 us of preamble   1283 us
///                802.11a, 54 Mb/s, 20 us of preamble     244 us
Duration wifi_airtime(WifiStandard standard, Duration preamble, BitRate rate, std::uint32_t bytes);

/// Physical layer "wifi": IEEE 802.11b, a and g. Error rates are in models/phy/error_rate.hpp. The
/// number in a Coding is a Modulation.
///
/// Access models "none" and "aloha" use Wifi without `framing`, that is, with simplified airtimes:
/// 64 bytes at 11 Mb/s with the long preamble take 192 us + 46.545 us on air.
struct Wifi {
    static constexpr std::string_view name = "wifi";

    /// Standard that determines airtimes by wifi_airtime(); empty: the airtime is the preamble plus
    /// bits / rate, rounded to the nearest nanosecond.
    std::optional<WifiStandard> framing = std::nullopt;

    static constexpr auto fields() {
        return describe(field(
            "framing", &Wifi::framing,
            "standard that determines the duration of a frame (symbols and additional fields); "
            "without a standard, the duration is the number of bits divided by the bit rate"));
    }

    /// Functions of a physical layer, see PhysicalLayer.
    Transmission transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const;
    std::span<const BitRate> rates() const;
    std::optional<Coding> coding(BitRate rate) const;
    double log_success(Coding coding, double sinr) const;
    Db certain_sinr(Coding coding) const;
};

/// Size [bytes] of a data frame without its message: 24 of header, 4 of frame check sequence.
inline constexpr std::uint32_t data_header_bytes = 28;

}  // namespace rovernet
