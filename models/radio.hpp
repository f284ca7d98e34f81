// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <string>

namespace rovernet {

/// A robot's radio. The defaults are the 2007 device's where it had one (45 mW, 2450 MHz, -75 dBm)
/// and IEEE 802.11b's otherwise (11 Mb/s, long preamble).
struct Radio {
    Dbm power{16.532125137753436};  ///< [dBm] transmitter output; the default is 45 mW
    Dbm sensitivity{-75};           ///< [dBm] the weakest signal that is received
    Hertz frequency{2450e6};        ///< [Hz]
    BitRate rate{11e6};             ///< [bit/s]
    Duration preamble{192'000};     ///< [ns] sent before the first bit
    Db antenna_gain{0};             ///< [dBi]
    Db cable_loss{0};               ///< [dB]
    Meters antenna_height{1};       ///< [m] above the robot's own z

    static constexpr auto fields() {
        return describe(
            field("power", &Radio::power, "transmitter output power"),
            field("sensitivity", &Radio::sensitivity, "the weakest signal that is received"),
            field("frequency", &Radio::frequency, positive, "carrier frequency"),
            field("rate", &Radio::rate, positive, "bit rate on air"),
            field("preamble", &Radio::preamble, non_negative, "sent before the first bit"),
            field("antenna_gain", &Radio::antenna_gain, "antenna gain, both ways"),
            field("cable_loss", &Radio::cable_loss, non_negative, "loss between radio and antenna"),
            field("antenna_height", &Radio::antenna_height, "antenna above the robot's own z"));
    }
};

/// The largest path loss [dB] at which `to` still receives `from`:
/// power + gain - cable loss of the transmitter, + gain - cable loss - sensitivity of the receiver.
/// Source: the 2007 thesis, table 3.1, with the sensitivity subtracted as it must be.
constexpr Db link_budget(const Radio& from, const Radio& to) {
    return (from.power - to.sensitivity) + from.antenna_gain - from.cable_loss + to.antenna_gain -
           to.cable_loss;
}

/// Received power [dBm] after `path_loss` between the antennas.
constexpr Dbm received_power(const Radio& from, const Radio& to, Db path_loss) {
    return from.power + from.antenna_gain - from.cable_loss - path_loss + to.antenna_gain -
           to.cable_loss;
}

/// Time on air of `bytes` [bytes]: preamble + bits / rate, rounded to the nearest nanosecond.
Duration airtime(const Radio& radio, std::uint32_t bytes);

}  // namespace rovernet
