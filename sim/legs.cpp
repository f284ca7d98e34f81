// SPDX-License-Identifier: MIT
#include "sim/legs.hpp"

#include <bit>

namespace rovernet {
namespace {

/// Equality of bits. Unlike ==, it distinguishes -0 from 0: a leg must be returned exactly as
/// given.
bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Whether a leg keeps its height and does not turn.
bool level(const Leg& leg) {
    return same_bits(leg.velocity.z, 0) && same_bits(leg.from.z, leg.to.z) &&
           same_bits(leg.turning, 0);
}

bool rests(const Leg& leg) {
    return leg.end == never && level(leg) && same_bits(leg.velocity.x, 0) &&
           same_bits(leg.velocity.y, 0) && same_bits(leg.from.x, leg.to.x) &&
           same_bits(leg.from.y, leg.to.y);
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
    // The old part is released first, so that its place can be reused.
    if (place.motion != at_rest) release_motion(place.motion);
    place.motion = rests(leg) ? at_rest : take_motion(leg);
}

std::uint32_t Legs::take_motion(const Leg& leg) {
    if (level(leg)) {
        const std::size_t motion = level_motions_.take();
        level_motions_[motion] = {leg.end, leg.velocity.x, leg.velocity.y, leg.to.x, leg.to.y};
        return static_cast<std::uint32_t>(motion);
    }
    const std::size_t motion = motions_.take();
    motions_[motion] = {leg.end, leg.velocity, leg.to, leg.turning};
    return static_cast<std::uint32_t>(motion) | not_level;
}

void Legs::release_motion(std::uint32_t motion) {
    if (is_level(motion)) return level_motions_.release(motion);
    motions_.release(motion & ~not_level);
}

}  // namespace rovernet
