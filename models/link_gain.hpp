// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <algorithm>

// Link budgets: received powers from transmit power, gains and losses. Medium uses these functions;
// LinkGain adds all gains of a link.

namespace rovernet {

/// Pose of an antenna: its position, and the heading of its robot.
struct Pose {
    /// Position of the antenna [m].
    Vec3 antenna;
    /// Heading of the robot [rad], counter-clockwise from the x axis.
    Radians heading{0};
};

/// Headings of sender and receiver when a frame begins [rad], for directional antennas.
struct Headings {
    Radians from, to;
};

/// Gain of a directional antenna towards a place, relative to antenna_gain [dB], <= 0; equations in
/// AntennaShape. Only the horizontal direction of the place counts; the gain is 0 dB straight above
/// and below.
/// @param radio  radio whose antenna check_antenna() has accepted
Db pattern_gain(const Radio& radio, const Pose& pose, Vec3 place);

/// Checks the pattern table of an antenna, which fields() cannot check: for the shape `table` the
/// antenna needs points, at angles that ascend within one turn, with gains of at most 0 dB.
/// @throws std::invalid_argument with a description of the fault
void check_antenna(const Radio& radio);

/// Gain [dB] of antenna and cable at each end of a link. All gains of a link are computed here.
struct LinkGain {
    /// Gain minus cable loss of the sender's and of the receiver's antenna.
    Db sender, receiver;

    /// Largest gains over all poses of the antennas: an upper bound, for the search for receivers.
    static constexpr LinkGain most(const Radio& from, const Radio& to) {
        return {from.antenna_gain - from.cable_loss, to.antenna_gain - to.cable_loss};
    }
    /// Gains for the antennas' poses, which are not computed if both antennas are isotropic.
    /// @param poses  returns the poses of the sender's and the receiver's antenna as a pair; called
    ///               only if one of the antennas is directional
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

/// Largest path loss [dB] at which `to` receives `from`: power + gain - cable loss of the
/// transmitter, + gain - cable loss - sensitivity of the receiver. The link is up if its path loss
/// is at most this budget. Two radios with all defaults have 16.53 dBm - (-75 dBm) = 91.53 dB.
///
/// Source: the 2007 thesis (docs/formats/worlds.md), table 3.1, corrected: the sensitivity is
/// subtracted.
constexpr Db link_budget(const Radio& from, const Radio& to, LinkGain gain) {
    return (from.power - to.sensitivity) + gain.sender + gain.receiver;
}
/// Link budget [dB] with the largest gains of the antennas: an upper bound for all poses.
constexpr Db link_budget(const Radio& from, const Radio& to) {
    return link_budget(from, to, LinkGain::most(from, to));
}

/// Largest path loss [dB] at which `to` senses a transmission of `from`; >= link_budget().
constexpr Db sensing_budget(const Radio& from, const Radio& to, LinkGain gain) {
    const Dbm threshold = to.carrier_sense_threshold.value_or(to.sensitivity);
    return link_budget(from, to, gain) + std::max(Db{0}, to.sensitivity - threshold);
}
/// Sensing budget [dB] with the largest gains of the antennas: an upper bound for all poses.
constexpr Db sensing_budget(const Radio& from, const Radio& to) {
    return sensing_budget(from, to, LinkGain::most(from, to));
}

/// Received power [dBm] after `path_loss` between the antennas: power + gains - losses. At 10 m in
/// free space, with default radios, it is 16.53 - 60.23 = -43.70 dBm.
constexpr Dbm received_power(const Radio& from, Db path_loss, LinkGain gain) {
    return from.power + gain.sender - path_loss + gain.receiver;
}
/// Received power [dBm] with the largest gains of the antennas: an upper bound for all poses.
constexpr Dbm received_power(const Radio& from, const Radio& to, Db path_loss) {
    return received_power(from, path_loss, LinkGain::most(from, to));
}

}  // namespace rovernet
