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

namespace rovernet {

/// A straight piece of motion: position(t) = from + velocity * (t - start), from `start` to `end`.
struct Leg {
    Time start = start_of_run;
    Time end = never;    ///< never: the leg holds until it is replaced
    Vec3 from = {};      ///< [m] position at `start`
    Vec3 velocity = {};  ///< [m/s]
    Vec3 to = {};        ///< [m] position at `end`; equal to `from` for a leg at rest
    double heading = 0;  ///< [rad] at `start`, counter-clockwise from the x axis
    double turning = 0;  ///< [rad/s], counter-clockwise; a robot turns at rest only

    Vec3 position(Time t) const {
        if (t >= end) return to;
        return from + seconds(t - start) * velocity;
    }
    /// Heading at `t` [rad], not wrapped: turning on adds up.
    double heading_at(Time t) const {
        return turning == 0 ? heading : heading + seconds(std::min(t, end) - start) * turning;
    }
};

/// The same heading [rad] within -pi ... pi.
inline double wrapped(double heading) {
    return std::abs(heading) < 3.141592653589793 ? heading
                                                 : std::remainder(heading, 6.283185307179586);
}

/// Where everybody is, as data: one current leg per node. Movement models write legs; the medium,
/// the scene and the pictures only read them.
///
/// A leg at rest takes 48 bytes, one at a constant height 40 more, any other 64 more.
class Legs {
  public:
    /// Room for `nodes` nodes.
    void reserve(std::size_t nodes) { places_.reserve(nodes); }
    /// Adds the next node, standing or moving on `leg`.
    NodeId add(const Leg& leg);
    /// Replaces a node's leg; its version counts up.
    void replace(NodeId node, const Leg& leg);

    std::size_t size() const { return places_.size(); }
    /// The node's leg, bit for bit as it was given.
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
    /// How often the node's leg has been replaced; tells a stale plan from the current one.
    std::uint32_t version(NodeId node) const { return places_[node.index()].version; }
    /// Where `node` is at `t` [m]; `t` must not lie before its leg.
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
    static constexpr std::uint32_t at_rest = 0xffffffff;
    static constexpr std::uint32_t not_level = 0x80000000;  // bit of a place in motions_
    static bool is_level(std::uint32_t motion) { return !(motion & not_level); }

    /// What every leg has.
    struct Place {
        Time start;
        Vec3 from;
        double heading;
        std::uint32_t version = 0;
        std::uint32_t motion = at_rest;  // its place in level_motions_, or in motions_
    };
    /// What a leg has that is not at rest, but keeps its height and does not turn.
    struct LevelMotion {
        Time end;
        double vx, vy;      // [m/s]
        double to_x, to_y;  // [m]
    };
    /// What any other leg has.
    struct Motion {
        Time end;
        Vec3 velocity;
        Vec3 to;
        double turning;
    };

    void put(Place& place, const Leg& leg);
    std::uint32_t take_motion(const Leg& leg);
    void release_motion(std::uint32_t motion);

    std::vector<Place> places_;  // by node
    Slots<LevelMotion> level_motions_;
    Slots<Motion> motions_;
};

}  // namespace rovernet
