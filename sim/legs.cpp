// SPDX-License-Identifier: MIT
#include "sim/legs.hpp"

#include <array>
#include <bit>

namespace rovernet {
namespace {

/// Unlike ==, tells -0 from 0: a leg must come back as it was given.
bool same_bits(Vec3 a, Vec3 b) {
    using Bits = std::array<std::uint64_t, 3>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

bool rests(const Leg& leg) {
    return leg.end == never && same_bits(leg.velocity, {}) && same_bits(leg.from, leg.to) &&
           std::bit_cast<std::uint64_t>(leg.turning) == 0;
}

}  // namespace

NodeId Legs::add(const Leg& leg) {
    const NodeId node{static_cast<std::uint32_t>(places_.size())};
    put(places_.emplace_back(), leg);
    return node;
}

void Legs::replace(NodeId node, const Leg& leg) {
    Place& place = places_[node.index()];
    put(place, leg);
    ++place.version;
}

void Legs::put(Place& place, const Leg& leg) {
    place.start = leg.start;
    place.from = leg.from;
    place.heading = leg.heading;
    const bool rested = place.motion == at_rest;
    if (rests(leg)) {
        if (!rested) motions_.release(place.motion);
        place.motion = at_rest;
        return;
    }
    if (rested) place.motion = static_cast<std::uint32_t>(motions_.take());
    motions_[place.motion] = {leg.end, leg.velocity, leg.to, leg.turning};
}

}  // namespace rovernet
