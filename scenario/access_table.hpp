// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/list.hpp"
#include "scenario/reader.hpp"
#include "sim/fields.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace rovernet {

/// How robots get access to the medium.
enum class AccessChoice { none, aloha, csma };
template <>
struct EnumNames<AccessChoice> {
    static constexpr std::array<std::string_view, 3> values = {"none", "aloha", "csma"};
};

/// [access]: keys of csma that are not given are those of its standard.
struct AccessTable {
    AccessChoice model = AccessChoice::none;
    std::optional<Duration> slot = std::nullopt;
    int queue = 50;
    WifiStandard standard = WifiStandard::b;
    std::optional<Duration> sifs = std::nullopt, difs = std::nullopt, cca_time = std::nullopt,
                            turnaround = std::nullopt, rx_start_delay = std::nullopt;
    std::optional<int> cw_min = std::nullopt, cw_max = std::nullopt;
    std::optional<std::vector<BitRate>> basic_rates = std::nullopt;
    bool eifs = true;
    int short_retries = Csma{}.short_retries;
    int long_retries = Csma{}.long_retries;
    Bytes rts_threshold{Csma{}.rts_threshold};
    Bytes header{Csma{}.header};

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
            field("eifs", &A::eifs, "wait longer after a frame with errors"),
            field("short_retries", &A::short_retries, non_negative, "attempts; 0: no end"),
            field("long_retries", &A::long_retries, non_negative, "behind an RTS; 0: no end"),
            field("rts_threshold", &A::rts_threshold, "larger unicasts ask with an RTS first"),
            field("header", &A::header, "that access adds to a message"));
    }
    AccessModel make() const;
    Csma csma() const;  ///< its settings, whatever the model
};

}  // namespace rovernet
