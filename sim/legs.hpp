// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/slots.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

// Where robots are, without ticks: an answer for any time, in constant time, from the current leg.
//
//     const NodeId node = legs.add({.end = start_of_run + 10s, .velocity = {1, 0}, .to = {10, 0}});
//     legs.position(node, start_of_run + 4s);  // {4, 0, 0}

namespace rovernet {

/// Straight piece of motion: position(t) = from + velocity * (t - start), from `start` to `end`.
///
/// A movement model answers one when it is asked where a robot goes next. A leg either moves or
/// turns: a robot turns at rest only.
struct Leg {
    /// Begin of the leg.
    Time start = start_of_run;
    /// End of the leg, when the movement model is asked again; never: it holds until it is
    /// replaced.
    Time end = never;
    /// Position at `start` [m].
    Vec3 from = {};
    /// Velocity [m/s]; zero while the robot turns or rests.
    Vec3 velocity = {};
    /// Position at `end` [m], equal to `from` for a leg at rest. It is given, so that rounding in
    /// position() never makes a robot miss its goal.
    Vec3 to = {};
    /// Heading at `start` [rad], counter-clockwise from the x axis.
    double heading = 0;
    /// Turn rate [rad/s], counter-clockwise.
    double turning = 0;

    /// Position at `t` >= start [m]; from `end` on it is `to`.
    Vec3 position(Time t) const {
        if (t >= end) return to;
        return from + seconds(t - start) * velocity;
    }
    /// Heading at `t` >= start [rad]; it stays as it is from `end` on. It is not wrapped: turning
    /// on adds up, and pictures of a turn go the right way round.
    double heading_at(Time t) const {
        return turning == 0 ? heading : heading + seconds(std::min(t, end) - start) * turning;
    }
};

/// Equivalent heading [rad] within -pi ... pi.
inline double wrapped(double heading) {
    return std::abs(heading) < 3.141592653589793 ? heading
                                                 : std::remainder(heading, 6.283185307179586);
}

/// Motion of all robots, as data: one current leg for each node. Nothing ticks: where a robot is at
/// any time follows from its leg. Motion writes the legs that movement models answer; the medium,
/// links and pictures only read them.
///
/// A leg at rest takes 48 bytes, one at a constant height 40 more, any other 64 more. The three
/// kinds give the same positions to the last bit as Leg::position(): how a leg is stored changes no
/// result.
class Legs {
  public:
    /// Makes room for `nodes` nodes in all.
    void reserve(std::size_t nodes) { places_.reserve(nodes); }
    /// Adds the next node, standing or moving on `leg`. @return its id: the number of nodes before
    NodeId add(const Leg& leg);
    /// Replaces a node's leg; its version counts up. What was planned for the old leg is stale
    /// then: an event at its end, a link change.
    void replace(NodeId node, const Leg& leg);

    /// Number of nodes.
    std::size_t size() const { return places_.size(); }
    /// Leg of the node, bit for bit as it was given.
    Leg leg(NodeId node) const {
        const Place& place = places_[node.index()];
        Leg leg{
            .start = place.start, .from = place.from, .to = place.from, .heading = place.heading};
        if (place.motion == at_rest) return leg;
        if (is_level(place.motion)) {
            const LevelMotion& motion = level_motions_[place.motion];
            leg.end = motion.end;
            leg.velocity = {motion.vx, motion.vy};
            leg.to = {motion.to_x, motion.to_y, place.from.z};
            return leg;
        }
        const Motion& motion = motions_[place.motion & ~not_level];
        leg.end = motion.end;
        leg.velocity = motion.velocity;
        leg.to = motion.to;
        leg.turning = motion.turning;
        return leg;
    }
    /// Number of times that the node's leg was replaced. An event at the end of a leg carries it,
    /// and is void if another leg has taken its place.
    std::uint32_t version(NodeId node) const { return places_[node.index()].version; }
    /// Position of `node` at `t` [m], as Leg::position() of its leg; `t` must not lie before the
    /// leg.
    Vec3 position(NodeId node, Time t) const {
        const Place& place = places_[node.index()];
        if (place.motion == at_rest) return place.from + Vec3{};  // adds 0, as a leg does
        if (is_level(place.motion)) {
            const LevelMotion& motion = level_motions_[place.motion];
            if (t >= motion.end) return {motion.to_x, motion.to_y, place.from.z};
            return place.from + seconds(t - place.start) * Vec3{motion.vx, motion.vy};
        }
        const Motion& motion = motions_[place.motion & ~not_level];
        if (t >= motion.end) return motion.to;
        return place.from + seconds(t - place.start) * motion.velocity;
    }

  private:
    // Place::motion of a leg at rest.
    static constexpr std::uint32_t at_rest = 0xffffffff;
    // Bit of Place::motion for a place in motions_.
    static constexpr std::uint32_t not_level = 0x80000000;
    // Whether a leg that does not rest has its part in level_motions_.
    static bool is_level(std::uint32_t motion) { return !(motion & not_level); }

    /// Part that every leg has.
    struct Place {
        Time start;
        /// Position at the start [m], heading there [rad].
        Vec3 from;
        double heading;
        /// Number of times that the leg was replaced.
        std::uint32_t version = 0;
        /// Place in level_motions_, or in motions_ with the bit not_level.
        std::uint32_t motion = at_rest;
    };
    /// Part of a leg that moves at a constant height and does not turn.
    struct LevelMotion {
        /// End of the leg.
        Time end;
        /// Velocity [m/s]; that of z is 0.
        double vx, vy;
        /// Position at the end [m].
        double to_x, to_y;
    };
    /// Part of any other leg.
    struct Motion {
        Time end;
        /// Velocity [m/s], position at the end [m], turn rate [rad/s].
        Vec3 velocity;
        Vec3 to;
        double turning;
    };

    // Stores a leg in a place whose old leg is void.
    void put(Place& place, const Leg& leg);
    // Stores the part of a leg that does not rest. @return what Place::motion says of it
    std::uint32_t take_motion(const Leg& leg);
    // Frees what take_motion() took.
    void release_motion(std::uint32_t motion);

    // Places by node; `motion` points into one of the lists below, whose places are used again.
    std::vector<Place> places_;
    Slots<LevelMotion> level_motions_;
    Slots<Motion> motions_;
};

}  // namespace rovernet
