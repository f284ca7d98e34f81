// SPDX-License-Identifier: MIT
#pragma once

#include "models/phy/phy.hpp"

#include <array>
#include <optional>
#include <span>
#include <string_view>

namespace rovernet {

/// Physical layer "chirp" with two spreading factors, for 1 and 8 kb/s. Receivers are 10 dB more
/// sensitive to the slow one. Frames of different spreading factors hardly interfere.
struct Chirp {
    static constexpr std::string_view name = "chirp";

    double rejection_of_other = 0.01;  ///< [-] share of the other factor's power that interferes

    static constexpr auto fields() {
        return describe(field("rejection_of_other", &Chirp::rejection_of_other,
                              Range{.low = 0, .high = 1, .text = "from 0 to 1"},
                              "share that counts"));
    }

    Transmission transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const;
    std::span<const BitRate> rates() const;
    std::optional<Coding> coding(BitRate rate) const;
    double log_success(Coding coding, double sinr) const;
    Db certain_sinr(Coding coding) const;
    Dbm sensitivity(const Radio& radio, Coding coding) const;
    double rejection(Coding wanted, Coding other) const;
    PreambleDetection preamble_detection(Coding coding) const;
};

}  // namespace rovernet
