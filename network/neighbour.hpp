// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <vector>

// Neighbours as a radio sees them: for tables of links, pictures and applications.

namespace rovernet {

class Medium;

/// Neighbour of a robot: one that it hears, as its radio sees it. The levels are local means,
/// without errors or interference.
struct Neighbour {
    NodeId node;
    /// Level [dBm] of the neighbour's signal here.
    Dbm level;
    /// Noise here [dBm]: thermal noise in the receiver's bandwidth, and its noise figure.
    Dbm noise;
    /// Quality of the link, 0 ... 100, see link_quality().
    int quality;
};

/// Quality of a link: 2 per decibel above the receiver's sensitivity, 0 at a margin of 0 dB, 100
/// from 50 dB on. Tables of links show it, as wireless tools do.
int link_quality(Db margin);

/// Neighbours that `node` hears at `t`, in order of id: those that are on, in its network, and
/// within the link budget. It takes a look at every node.
/// @param legs  of the medium's nodes; `t` must not lie before them
std::vector<Neighbour> neighbours(const Medium& medium, const Legs& legs, NodeId node, Time t);

}  // namespace rovernet
