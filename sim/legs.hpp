// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/leg.hpp"
#include "sim/slots.hpp"
#include "sim/time.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

// Positions of robots without time steps: at any time, in constant time, from the current leg.
//
//     const NodeId node = legs.add({.end = start_of_run + 10s, .velocity = {1, 0}, .to = {10, 0}});
//     legs.position(node, start_of_run + 4s);  // {4, 0, 0}

namespace rovernet {

/// Motion of all robots as data: one current leg for each node. There are no time steps: the
/// position of a robot at any time follows from its leg. Motion writes the legs that movement
/// models return; medium, links and pictures only read them.
///
/// Memory: 48 bytes for a leg at rest, 40 more for a leg at constant height, 64 more for any other
/// leg. All three kinds give exactly the positions of Leg::position(); the storage changes no
/// result.
class Legs {
  public:
    /// Reserves memory for `nodes` nodes in total.
    void reserve(std::size_t nodes) { places_.reserve(nodes); }
    /// Adds the next node, at rest or moving on `leg`. @return its id: number of nodes before
    NodeId add(const Leg& leg);
    /// Replaces a node's leg and increments its version. Events planned for the old leg (its end, a
    /// link change) are then ignored.
    void replace(NodeId node, const Leg& leg);

    /// Number of nodes.
    std::size_t size() const { return places_.size(); }
    /// Leg of the node, exactly as passed to add() or replace().
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
    /// Number of times that the node's leg was replaced. An event at the end of a leg stores the
    /// version, and is ignored if the leg was replaced since.
    std::uint32_t version(NodeId node) const { return places_[node.index()].version; }
    /// Position of `node` at `t` [m], equal to Leg::position() of its leg; `t` must not be before
    /// the leg's start.
    Vec3 position(NodeId node, Time t) const {
        const Place& place = places_[node.index()];
        if (place.motion == at_rest) return place.from + Vec3{};  // -0 becomes 0, as in Leg
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
    // Value of Place::motion for a leg at rest.
    static constexpr std::uint32_t at_rest = 0xffffffff;
    // Bit of Place::motion. Set: the other bits are an index into motions_. Not set: the other bits
    // are an index into level_motions_.
    static constexpr std::uint32_t not_level = 0x80000000;
    // Whether a moving leg's Place::motion is an index into level_motions_.
    static bool is_level(std::uint32_t motion) { return !(motion & not_level); }

    /// Data of every leg; `motion` refers to the additional data of a leg that is not at rest.
    struct Place {
        Time start;
        /// Position at the leg's start [m] and heading there [rad].
        Vec3 from;
        double heading;
        /// Number of times that the node's leg was replaced.
        std::uint32_t version = 0;
        /// Value at_rest, or an index into level_motions_, or an index into motions_ with the bit
        /// not_level set.
        std::uint32_t motion = at_rest;
    };
    /// Data of a moving leg at constant height without a turn.
    struct LevelMotion {
        /// Time at which the leg ends.
        Time end;
        /// Velocity of the leg [m/s] in x and y; 0 in z.
        double vx, vy;
        /// Position at the end of the leg [m].
        double to_x, to_y;
    };
    /// Data of any other moving leg: one with a climb or a turn.
    struct Motion {
        Time end;
        /// Velocity [m/s], position at the end [m], and turn rate [rad/s] of the leg.
        Vec3 velocity;
        Vec3 to;
        double turning;
    };

    // Stores a leg in `place` and, if the leg is not at rest, in one of the two lists of motions.
    void put(Place& place, const Leg& leg);
    // Stores the motion of a leg that is not at rest in level_motions_ or motions_.
    // @return value of Place::motion for the leg
    std::uint32_t take_motion(const Leg& leg);
    // Frees the entry of level_motions_ or motions_ to which a value of Place::motion refers.
    void release_motion(std::uint32_t motion);

    // Places by node; Place::motion is an index into one of the two lists below.
    std::vector<Place> places_;
    Slots<LevelMotion> level_motions_;
    Slots<Motion> motions_;
};

}  // namespace rovernet
