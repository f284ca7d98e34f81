// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/list.hpp"
#include "scenario/tables/reader.hpp"
#include "sim/fields.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

// Access to the medium as a scenario file gives it:
//
//     [access]
//     model = "csma"
//     standard = "802.11g"
//     basic_rates = ["6 Mb/s"]

namespace rovernet {

/// Words of [access] model: how robots get access to the medium.
///
/// - none: a frame goes on air at once, whatever else is there
/// - aloha: a robot's own frames wait for one another; it does not listen
/// - csma: the distributed coordination function (DCF) of IEEE 802.11
enum class AccessChoice { none, aloha, csma };
template <>
struct EnumNames<AccessChoice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "aloha", "csma"};
};

/// Reads [access] eifs: a word, or, as in files of earlier versions, true (standard) or false
/// (none).
/// @throws InputError for anything else
void read_value(const Value& value, std::string_view key, EifsRule& out);

/// [access]: the chosen model and the parameters of all. Those of csma that are not given are its
/// standard's; one that is given for a model that is not chosen is checked and kept.
struct AccessTable {
    AccessChoice model = AccessChoice::none;
    /// Slot [ns]: of the backoff of csma, by default the standard's; of aloha frames begin at
    /// multiples of it, by default 0: pure ALOHA.
    std::optional<Duration> slot = std::nullopt;
    /// Frames that wait at a robot at most; one more is dropped (IFQ).
    int queue = 50;
    /// Standard whose timing and airtimes csma has.
    WifiStandard standard = WifiStandard::b;
    /// Times of csma [ns]: interframe spaces, time until energy is sensed, time from deciding to
    /// sending, time until an answer is noticed. `difs` is `sifs` and two slots if it is not given.
    std::optional<Duration> sifs = std::nullopt, difs = std::nullopt, cca_time = std::nullopt,
                            turnaround = std::nullopt, rx_start_delay = std::nullopt;
    /// Contention window of csma, least and largest [slots].
    std::optional<int> cw_min = std::nullopt, cw_max = std::nullopt;
    /// Basic rates of csma [bit/s]: broadcasts and RTS go at the lowest, CTS and ACK at the highest
    /// that is not above the rate of what they answer.
    std::optional<std::vector<BitRate>> basic_rates = std::nullopt;
    /// Frames after which csma waits longer (EIFS), as if an acknowledgement followed. With ns2
    /// the defaults of the keys above are those of ns-2, see ns2_timing().
    EifsRule eifs = EifsRule::standard;
    /// Attempts at a unicast of csma, and at one behind an RTS, before it is given up (RET); 0: no
    /// end.
    int short_retries = Csma{}.short_retries;
    int long_retries = Csma{}.long_retries;
    /// Size [bytes], header included, above which a unicast of csma asks with an RTS first.
    Bytes rts_threshold{Csma{}.rts_threshold};
    /// Size [bytes] that csma adds to a message.
    Bytes header{Csma{}.header};

    /// Ranges here hold for each key alone; read_scenario() checks what csma needs of several
    /// together.
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
            field("short_retries", &A::short_retries, non_negative, "attempts; 0: no end"),
            field("long_retries", &A::long_retries, non_negative, "behind an RTS; 0: no end"),
            field("rts_threshold", &A::rts_threshold, "larger unicasts ask with an RTS first"),
            field("header", &A::header, "that access adds to a message"));
    }
    /// Chosen model with its parameters. network_settings() asks for it.
    AccessModel make() const;
    /// Settings of csma, whatever the model: for checks of the table.
    Csma csma() const;
};

}  // namespace rovernet
