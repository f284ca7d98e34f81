// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/list.hpp"
#include "sim/fields.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

// Medium access in a scenario file:
//
//     [access]
//     model = "csma"
//     standard = "802.11g"
//     basic_rates = ["6 Mb/s"]

namespace rovernet {

/// Values of [access] model: the medium access protocol.
///
/// - none: a frame is transmitted at once, even if the medium or the robot's own radio is busy
/// - aloha: frames of one robot are transmitted one after the other, without carrier sensing
/// - csma: the distributed coordination function (DCF) of IEEE 802.11
enum class AccessChoice { none, aloha, csma };
template <>
struct EnumNames<AccessChoice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "aloha", "csma"};
};

/// Reads [access] eifs: a name of EifsRule, or a boolean as in files of earlier versions: true
/// (standard), false (none).
/// @throws InputError for anything else
void read_value(const Value& value, std::string_view key, EifsRule& out);

/// [access]: the chosen model and the parameters of all models. Missing parameters of csma take the
/// values of `standard`. Parameters of a model that is not chosen are checked and kept.
struct AccessTable {
    AccessChoice model = AccessChoice::none;
    /// Slot time [ns]. csma: slot of the backoff, by default that of the standard. aloha: frames
    /// start at multiples of it; by default 0, pure ALOHA.
    std::optional<Duration> slot = std::nullopt;
    /// Length of a robot's transmit queue [frames]; a frame that finds it full is dropped (IFQ).
    int queue = 50;
    /// 802.11 standard that gives csma its timing and airtimes.
    WifiStandard standard = WifiStandard::b;
    /// Times of csma [ns]: interframe spaces SIFS and DIFS; time to sense energy (CCA);
    /// receive-to-transmit turnaround; delay until the start of an answer is detected. Without
    /// `difs`, DIFS = SIFS + 2 slots.
    std::optional<Duration> sifs = std::nullopt, difs = std::nullopt, cca_time = std::nullopt,
                            turnaround = std::nullopt, rx_start_delay = std::nullopt;
    /// Contention window of csma, least and largest [slots].
    std::optional<int> cw_min = std::nullopt, cw_max = std::nullopt;
    /// Basic rates of csma [bit/s]: broadcasts and RTS use the lowest one; CTS and ACK use the
    /// highest one that does not exceed the rate of the frame that they answer.
    std::optional<std::vector<BitRate>> basic_rates = std::nullopt;
    /// Rule after which frames csma waits EIFS (room for an ACK) instead of DIFS. With `ns2`, other
    /// keys take the defaults of ns-2, too, see ns2_timing().
    EifsRule eifs = EifsRule::standard;
    /// Whether a csma station that finds the medium idle transmits without a backoff; by default
    /// true, but false with eifs = ns2.
    std::optional<bool> immediate_access = std::nullopt;
    /// Retry limits of csma: attempts at a unicast without and with RTS before it is dropped (RET);
    /// 0: no limit.
    int short_retries = Csma{}.short_retries;
    int long_retries = Csma{}.long_retries;
    /// Size [bytes], including the header, above which a csma unicast is preceded by an RTS.
    Bytes rts_threshold{Csma{}.rts_threshold};
    /// Header that csma adds to a message [bytes].
    Bytes header{Csma{}.header};

    /// Ranges of single keys; read_scenario() checks conditions of csma on several keys.
    static constexpr auto fields() {
        constexpr Range counts{.low = 1, .high = 1000000, .text = "from 1 to 1000000"};
        constexpr Range window{.low = 0, .high = 65535, .text = "from 0 to 65535"};
        using A = AccessTable;
        return describe(
            field("model", &A::model, "none: at once; aloha: no listening; csma: 802.11 DCF"),
            field("slot", &A::slot, non_negative, "of csma's backoff, or of slotted aloha"),
            field("queue", &A::queue, counts, "frames that wait at a robot, at most"),
            field("standard", &A::standard, "of csma: its timing and airtimes"),
            field("sifs", &A::sifs, non_negative, "short interframe space"),
            field("difs", &A::difs, non_negative, "DCF interframe space"),
            field("cca_time", &A::cca_time, non_negative, "energy is sensed so long after it came"),
            field("turnaround", &A::turnaround, non_negative, "from deciding to send to sending"),
            field("rx_start_delay", &A::rx_start_delay, non_negative,
                  "until the beginning of an answer is noticed"),
            field("cw_min", &A::cw_min, window, "least contention window, in slots"),
            field("cw_max", &A::cw_max, window, "largest contention window, in slots"),
            field("basic_rates", &A::basic_rates,
                  "broadcasts and RTS go at the lowest, answers at the highest not above the "
                  "asker's"),
            field("eifs", &A::eifs,
                  "longer wait after a frame that was begun and lost (standard), sensed and not "
                  "decoded (ns2), or none"),
            field("immediate_access", &A::immediate_access,
                  "a station that finds the medium idle sends without a backoff"),
            field("short_retries", &A::short_retries, non_negative, "attempts; 0: no end"),
            field("long_retries", &A::long_retries, non_negative, "behind an RTS; 0: no end"),
            field("rts_threshold", &A::rts_threshold, "larger unicasts ask with an RTS first"),
            field("header", &A::header, "that access adds to a message"));
    }
    /// Chosen model with its parameters. network_settings() calls it.
    AccessModel make() const;
    /// Settings of csma, even if another model is chosen: for checks of the table.
    Csma csma() const;
};

}  // namespace rovernet
