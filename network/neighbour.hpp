// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <vector>

// Neighbours of a robot in the radio network: for link tables, pictures and applications.

namespace rovernet {

class Legs;
class Medium;

/// Neighbour of a robot: a second robot whose signals the first robot can receive. Received powers
/// are local means, without errors or interference.
struct Neighbour {
    NodeId node;
    /// Received power [dBm] of the neighbour's signal at the robot.
    Dbm level;
    /// Noise [dBm] at the robot: thermal noise in the receiver's bandwidth, plus the receiver's
    /// noise figure.
    Dbm noise;
    /// Quality of the link, 0 ... 100, see link_quality().
    int quality;
};

/// Quality of a link, as wireless tools show it in link tables: 2 for each decibel of margin above
/// the receiver's sensitivity, 0 at a margin of 0 dB, 100 from 50 dB on.
/// @param margin  received power relative to the receiver's sensitivity [dB]
int link_quality(Db margin);

/// Neighbours that `node` can hear at `t`, in order of id: nodes that are on, in the network of
/// `node`, and within the link budget. The function checks every node.
/// @param legs  legs of the medium's nodes; `t` must not be before their starts
std::vector<Neighbour> neighbours(const Medium& medium, const Legs& legs, NodeId node, Time t);

}  // namespace rovernet
