// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/phy/wifi.hpp"
#include "models/radio.hpp"
#include "sim/fields.hpp"

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// Rule for the EIFS: a waiting time after a frame that a station did not decode, longer than a
/// DIFS because it includes time for an acknowledgement.
///
/// - standard: EIFS after a frame that the station had locked onto; a received frame without errors
///   ends the EIFS (802.11-2020, 10.3.2.3.7)
/// - ns2: EIFS after each sensed frame, decodable or not, unless the station is transmitting. No
///   frame ends the EIFS early (like a NAV), and a DIFS follows the EIFS
/// - none: no EIFS
enum class EifsRule { standard, ns2, none };
/// Names of the values of [access] eifs in scenario files.
template <>
struct EnumNames<EifsRule> {
    static constexpr std::array<std::string_view, 3> values = {"standard", "ns2", "none"};
};

/// Timing of a standard, changed as in ns-2.35: energy is sensed without delay, there is no
/// turnaround time, and a backoff has 0 to CW - 1 slots.
constexpr WifiTiming ns2_timing(WifiTiming timing) {
    timing.cca_time = timing.turnaround = Duration{0};
    --timing.cw_min;
    --timing.cw_max;
    return timing;
}

/// Settings of the 802.11 DCF, as a scenario file gives them. An empty value stands for the value
/// of the standard. Example: examples/hidden_node.cpp.
struct Csma {
    static constexpr std::string_view name = "csma";

    /// Backoff slot [ns], > 0.
    std::optional<Duration> slot = std::nullopt;
    /// Largest number of frames waiting at a node; further frames are dropped (IFQ).
    int queue = 50;
    /// Standard of IEEE 802.11, which determines airtimes, default timing and default radio.
    WifiStandard standard = WifiStandard::b;
    /// Times [ns]: interframe spaces SIFS and DIFS; time to sense energy (CCA); receive-to-transmit
    /// turnaround; delay until the start of an answer is detected. Without `difs`, DIFS = SIFS + 2
    /// slots.
    std::optional<Duration> sifs = std::nullopt, difs = std::nullopt, cca_time = std::nullopt,
                            turnaround = std::nullopt, rx_start_delay = std::nullopt;
    /// Contention window, least and largest [slots]. `cw_max` is at least `cw_min`.
    std::optional<int> cw_min = std::nullopt, cw_max = std::nullopt;
    /// Basic rates [bit/s], at least one, in any order; by default the mandatory rates of the
    /// standard. Broadcasts and RTS use the lowest basic rate. A response (CTS, ACK) uses the
    /// highest basic rate up to the rate of the answered frame, or else the lowest basic rate.
    std::optional<std::vector<BitRate>> basic_rates = std::nullopt;
    /// Rule for the EIFS, a longer waiting time after a frame that was not decoded. With `ns2`, the
    /// default timing is that of ns-2, see ns2_timing().
    EifsRule eifs = EifsRule::standard;
    /// True: a station that finds the medium idle for a DIFS sends without a backoff (802.11-2020,
    /// 10.3.4.2). False: a backoff precedes every frame, as in ns-2. By default true, but false if
    /// `eifs` is `ns2`.
    std::optional<bool> immediate_access = std::nullopt;
    /// Retry limit of an RTS, or of data without RTS; 0: unlimited.
    int short_retries = 7;
    /// Retry limit of data after an RTS; 0: unlimited.
    int long_retries = 4;
    /// Size [bytes], including the header, above which a unicast is preceded by an RTS.
    Bytes rts_threshold = 2347;
    /// Size [bytes] of the header that the access model adds to a message.
    Bytes header = data_header_bytes;
    /// True if control packets of the routing protocol are sent before messages of applications, as
    /// in ns-2's CMUPriQueue.
    bool priority = false;

    /// Parameters with their ranges; make_access() checks conditions on several parameters.
    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1000000, .text = "from 1 to 1000000"};
        constexpr Range window{.low = 0, .high = 65535, .text = "from 0 to 65535"};
        return describe(
            field("slot", &Csma::slot, non_negative, "duration of a backoff slot"),
            field("queue", &Csma::queue, counts, "largest number of frames that wait at a robot"),
            field("standard", &Csma::standard,
                  "standard that gives the timing and the airtimes; with 802.11a and 802.11g, the "
                  "defaults of the keys `rate` and `preamble` of [radio] are 54 Mb/s and 20 us"),
            field("sifs", &Csma::sifs, non_negative, "short interframe space (SIFS)"),
            field("difs", &Csma::difs, non_negative,
                  "DCF interframe space (DIFS); if not given, a SIFS and two slots"),
            field("cca_time", &Csma::cca_time, non_negative,
                  "time from the arrival of a signal until a station senses the signal"),
            field("turnaround", &Csma::turnaround, non_negative,
                  "time from the decision of a station to send until its frame begins"),
            field("rx_start_delay", &Csma::rx_start_delay, non_negative,
                  "part of the time limit for an answer (CTS or ACK): the answer counts as missing "
                  "after a SIFS, a slot and this delay"),
            field("cw_min", &Csma::cw_min, window, "smallest contention window, in slots"),
            field("cw_max", &Csma::cw_max, window, "largest contention window, in slots"),
            field("basic_rates", &Csma::basic_rates,
                  "broadcasts and RTS use the lowest of these rates; CTS and ACK use the highest "
                  "of these rates that is not above the rate of the frame that they answer"),
            field("eifs", &Csma::eifs,
                  "when a station waits for an EIFS (extended interframe space) instead of a DIFS. "
                  "standard: after a frame whose reception began and failed; ns2: after every "
                  "frame that the station sensed but did not decode; none: never"),
            field("immediate_access", &Csma::immediate_access,
                  "true: a station that finds the medium idle sends after a DIFS, without a "
                  "backoff; false: a station draws a backoff before every frame"),
            field("short_retries", &Csma::short_retries, non_negative,
                  "largest number of attempts to send an RTS, or a unicast without an RTS; 0: no "
                  "limit"),
            field("long_retries", &Csma::long_retries, non_negative,
                  "largest number of attempts to send a unicast after an RTS; 0: no limit"),
            field("rts_threshold", &Csma::rts_threshold,
                  "before a unicast that is larger than this size, a station sends an RTS"),
            field("header", &Csma::header,
                  "size of the header that the access model adds to a message"),
            field("priority", &Csma::priority,
                  "true: control packets of the routing protocol are sent before messages"));
    }

    /// Complete timing: times that are not given have the values of the standard.
    WifiTiming timing() const;
    /// Whether a station that finds the medium idle for a DIFS sends without a backoff.
    bool sends_at_once() const { return immediate_access.value_or(eifs != EifsRule::ns2); }
    /// Default radio, for keys of [radio] that a scenario file does not give: Radio{} for 802.11b;
    /// for OFDM the bit rate is 54 Mbit/s and the preamble 20 us.
    Radio usual_radio() const {
        if (standard == WifiStandard::b) return {};
        return {.rate = {54e6}, .preamble = std::chrono::microseconds{20}};
    }
    /// Creates the model for one Network.
    /// @throws std::invalid_argument if the slot is not > 0, or there is no basic rate
    std::unique_ptr<Access> make_access() const;
};

}  // namespace rovernet
