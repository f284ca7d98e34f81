// SPDX-License-Identifier: MIT
#pragma once

#include "models/antenna.hpp"
#include "models/radio_labels.hpp"
#include "sim/fields.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// Radios of robots. Scenario files have their parameters in [radio] and in a robot's own `radio`;
// in code they are designated initialisers:
//
//     network.add({.name = "A", .radio = {.power = 20_dBm, .rate = 11_Mbps}});

namespace rovernet {

/// Rule (gate) that restricts the radios with which a radio can have links.
enum class Gate {
    /// Links only within a network: same essid ("any" matches all), channel and frequency.
    network,
    /// Radios of any network.
    none,
};
/// Names of the values of `gate` in scenario files.
template <>
struct EnumNames<Gate> {
    static constexpr std::array<std::string_view, 2> values = {"network", "none"};
};

/// Radio of a robot. Power, frequency and sensitivity have the defaults of a 2007 thesis
/// (docs/formats/worlds.md): 45 mW, 2450 MHz, -75 dBm. Other defaults are from IEEE 802.11b (11
/// Mb/s, long preamble). In free space two default radios hear each other up to 367 m.
struct Radio {
    /// Output power of the transmitter [dBm]; the default is 45 mW.
    Dbm power{16.532125137753436};
    /// Weakest signal that is received [dBm].
    Dbm sensitivity{-75};
    /// Weakest signal that is sensed [dBm]; equal to the sensitivity if not given. Weaker signals
    /// have no effect on channel access.
    std::optional<Dbm> carrier_sense_threshold = std::nullopt;
    /// Carrier frequency [Hz], for path losses and for the gate.
    Hertz frequency{2450e6};
    /// Bit rate of the radio's transmissions [bit/s].
    BitRate rate{11e6};
    /// Duration of the preamble [ns], before the first bit.
    Duration preamble{192'000};
    /// Gain of the antenna [dBi], for sending and receiving; for a directional antenna in its
    /// strongest direction.
    Db antenna_gain{0};
    /// Shape of the antenna's pattern; isotropic if not given.
    std::optional<AntennaShape> antenna = std::nullopt;
    /// Direction of a directional antenna [rad], counter-clockwise from the robot's heading; 0 if
    /// not given.
    std::optional<Radians> antenna_direction = std::nullopt;
    /// Beamwidth of the shape `cosine` [rad] between its -3 dB directions; 60 degrees if not given.
    std::optional<Radians> antenna_beamwidth = std::nullopt;
    /// Front-to-back ratio of the shape `cosine` [dB]: strongest to weakest direction; 20 dB if not
    /// given.
    std::optional<Db> front_to_back = std::nullopt;
    /// Points of the antenna pattern, for the shape `table`.
    std::optional<std::vector<PatternPoint>> antenna_pattern = std::nullopt;
    /// Cable loss between radio and antenna [dB].
    Db cable_loss{0};
    /// Height of the antenna above the robot's z [m].
    Meters antenna_height{1};
    /// Bandwidth of the receiver's filter [Hz], for the noise floor.
    Hertz bandwidth{22e6};
    /// Noise figure of the receiver [dB].
    Db noise_figure{7};
    /// Probability [-] that a frame of this radio is received without errors within range, drawn
    /// for each receiver and frame.
    double success_rate = 1;

    /// Name of the radio's network (essid); "any" matches all.
    std::string essid = "any";
    /// Channel number, which must be equal at both ends of a link; 0 if not used.
    int channel = 0;
    /// Gate of the radio: links only with radios of its own network, or with any radio.
    Gate gate = Gate::network;
    /// Labels, without effect on links.
    RadioLabels labels = {};

    /// Whether the gain of the radio's antenna depends on the direction.
    bool is_directional() const {
        return antenna.value_or(AntennaShape::isotropic) != AntennaShape::isotropic;
    }

    friend bool operator==(const Radio&, const Radio&) = default;

    /// Parameters in scenario files; RadioLabels::fields() has the labels beside them.
    static constexpr auto fields() {
        return describe(
            field("power", &Radio::power, "output power of the transmitter"),
            field("sensitivity", &Radio::sensitivity, "weakest signal that the radio decodes"),
            field("carrier_sense_threshold", &Radio::carrier_sense_threshold,
                  "weakest signal that the radio senses, even if it cannot decode the signal; if "
                  "not given, the sensitivity"),
            field("frequency", &Radio::frequency, positive, "frequency of the carrier"),
            field("rate", &Radio::rate, Range{.low = 1, .text = ">= 1 bit/s"},
                  "bit rate on air; if not given, the default of the [access] standard"),
            field("preamble", &Radio::preamble,
                  Range{.low = 0, .high = 1e9, .text = "from 0 to 1e9 s"},
                  "duration of the preamble, which is sent before the first bit; if not given, the "
                  "default of the [access] standard"),
            field("antenna_gain", &Radio::antenna_gain,
                  "antenna gain, for sending and for receiving"),
            field("antenna", &Radio::antenna,
                  "shape of the antenna's pattern: isotropic, cosine "
                  "or table"),
            field("antenna_direction", &Radio::antenna_direction,
                  "direction of a directional antenna, counter-clockwise from the robot's heading"),
            field("antenna_beamwidth", &Radio::antenna_beamwidth, beamwidths,
                  "for cosine: angle between the two directions in which the gain is 3 dB below "
                  "its maximum"),
            field("front_to_back", &Radio::front_to_back, non_negative,
                  "for cosine: gain in the strongest direction relative to the gain in the weakest "
                  "direction"),
            field("antenna_pattern", &Radio::antenna_pattern,
                  "for table: points [angle in degrees, gain in dB]; the angles are "
                  "counter-clockwise from the antenna's direction"),
            field("cable_loss", &Radio::cable_loss, non_negative,
                  "loss between radio and antenna, for sending and for receiving"),
            field("antenna_height", &Radio::antenna_height,
                  "height of the antenna above the z coordinate of the robot"),
            field("bandwidth", &Radio::bandwidth, positive, "bandwidth of the receiver's filter"),
            field("noise_figure", &Radio::noise_figure, non_negative,
                  "noise figure of the receiver"),
            field("success_rate", &Radio::success_rate,
                  Range{.low = 0, .high = 1, .text = "from 0 to 1"},
                  "probability that a receiver in range receives a frame of this sender"),
            field("essid", &Radio::essid,
                  "name of the radio's network; \"any\" joins all networks"),
            field("channel", &Radio::channel, non_negative,
                  "channel number; both robots of a link must have the same number"),
            field("gate", &Radio::gate,
                  "network: only radios with the same essid, channel and frequency receive each "
                  "other; none: all radios receive each other"));
    }
};

/// Noise floor of a receiver [dBm]: thermal noise at 290 K in its bandwidth, plus its noise figure:
/// -173.975 dBm + 10 log10(B / 1 Hz) + NF. With the defaults of a radio the noise floor is -93.55
/// dBm.
///
/// Source: k T_0 with the CODATA 2018 value of k.
Dbm noise_floor(Hertz bandwidth, Db noise_figure);
/// Noise floor of a radio's receiver [dBm].
Dbm noise_floor(const Radio& radio);

}  // namespace rovernet
