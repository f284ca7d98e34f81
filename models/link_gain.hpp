// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <algorithm>
#include <utility>

// Link budgets: levels from powers, gains and losses. Medium asks them; whoever adds a gain to a
// link adds it in LinkGain.

namespace rovernet {

/// Pose of an antenna, as a link sees it: where it is, and where its robot heads.
struct Pose {
    /// Position of the antenna [m].
    Vec3 antenna;
    /// Heading of the robot [rad], counter-clockwise from the x axis.
    Radians heading{0};
};

/// Headings of both ends of a frame when it begins [rad], for directional antennas.
struct Headings {
    Radians from, to;
};

/// Gain of a directional antenna towards a place, below antenna_gain [dB], <= 0; its equations are
/// those of AntennaShape. The place counts by its horizontal direction from the antenna; straight
/// above and below the gain is 0 dB.
/// @param radio  checked by check_antenna()
Db pattern_gain(const Radio& radio, const Pose& pose, Vec3 place);

/// Checks what fields() cannot: a pattern's table has points if the shape is `table`, at angles
/// that ascend within one turn, with gains of at most 0 dB.
/// @throws std::invalid_argument saying what is wrong
void check_antenna(const Radio& radio);

/// Gain of antennas and cables on a link [dB], by its ends. Gains are added here and nowhere else.
struct LinkGain {
    /// Gain less cable loss at each end.
    Db sender, receiver;

    /// Largest gains, whatever the poses of the antennas: they bound the search for receivers.
    static constexpr LinkGain most(const Radio& from, const Radio& to) {
        return {from.antenna_gain - from.cable_loss, to.antenna_gain - to.cable_loss};
    }
    /// Gains of antennas in their poses, which cost nothing where both are isotropic.
    /// @param poses  returns the Pose of the sender's antenna and that of the receiver's, as a
    /// pair; called only if one of the antennas is directional
    template <class Poses>
    static LinkGain of(const Radio& from, const Radio& to, const Poses& poses) {
        LinkGain gain = most(from, to);
        if (!from.is_directional() && !to.is_directional()) return gain;
        const auto [here, there] = poses();
        gain.sender = gain.sender + pattern_gain(from, here, there.antenna);
        gain.receiver = gain.receiver + pattern_gain(to, there, here.antenna);
        return gain;
    }
};

/// Largest path loss [dB] at which `to` still receives `from`: power + gain - cable loss of the
/// transmitter, + gain - cable loss - sensitivity of the receiver. The link is up if its loss is no
/// larger. Two radios with all defaults have 16.53 dBm - (-75 dBm) = 91.53 dB.
///
/// Source: the 2007 thesis, table 3.1, with the sensitivity subtracted as it must be.
constexpr Db link_budget(const Radio& from, const Radio& to, LinkGain gain) {
    return (from.power - to.sensitivity) + gain.sender + gain.receiver;
}
/// Link budget with the largest gains [dB].
constexpr Db link_budget(const Radio& from, const Radio& to) {
    return link_budget(from, to, LinkGain::most(from, to));
}

/// Largest path loss [dB] at which `to` senses that `from` sends; no less than link_budget.
constexpr Db sensing_budget(const Radio& from, const Radio& to, LinkGain gain) {
    const Dbm threshold = to.carrier_sense_threshold.value_or(to.sensitivity);
    return link_budget(from, to, gain) + std::max(Db{0}, to.sensitivity - threshold);
}
/// Sensing budget with the largest gains [dB].
constexpr Db sensing_budget(const Radio& from, const Radio& to) {
    return sensing_budget(from, to, LinkGain::most(from, to));
}

/// Received power [dBm] after `path_loss` between the antennas: power + gains - losses. At 10 m in
/// free space, with the defaults of radios, it is 16.53 - 60.23 = -43.70 dBm.
constexpr Dbm received_power(const Radio& from, Db path_loss, LinkGain gain) {
    return from.power + gain.sender - path_loss + gain.receiver;
}
/// Received power with the largest gains [dBm].
constexpr Dbm received_power(const Radio& from, const Radio& to, Db path_loss) {
    return received_power(from, path_loss, LinkGain::most(from, to));
}

}  // namespace rovernet
