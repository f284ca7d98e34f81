// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <cmath>
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
inline double wrapped(double heading) { return std::remainder(heading, 6.283185307179586); }

/// Where everybody is, as data: one current leg per node. Movement models write legs; the medium,
/// the scene and the pictures only read them.
class Legs {
  public:
    /// Adds the next node, standing or moving on `leg`.
    NodeId add(const Leg& leg);
    /// Replaces a node's leg; its version counts up.
    void replace(NodeId node, const Leg& leg);

    std::size_t size() const { return legs_.size(); }
    const Leg& leg(NodeId node) const { return legs_[node.index()]; }
    /// How often the node's leg has been replaced; tells a stale plan from the current one.
    std::uint32_t version(NodeId node) const { return versions_[node.index()]; }
    /// Where `node` is at `t` [m]; `t` must not lie before its leg.
    Vec3 position(NodeId node, Time t) const { return legs_[node.index()].position(t); }

  private:
    std::vector<Leg> legs_;
    std::vector<std::uint32_t> versions_;
};

}  // namespace rovernet
