// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"

#include <vector>

namespace rovernet {

/// Sink that stores every leg (piece of movement) of each robot, for drawing trails (past paths).
class Trails {
  public:
    KindMask kinds() const { return kind_of<Moved>(); }
    void on(const Record& record, const RecordContext& context);

    /// Past paths of a robot until `at`, each as its corners [m] in order; a new path starts where
    /// the robot was teleported. Empty if the robot never had a leg.
    std::vector<std::vector<Vec3>> ways(NodeId node, Time at) const {
        return ways(node, start_of_run, at);
    }
    /// Past paths of a robot from the time `begin` until `at`.
    std::vector<std::vector<Vec3>> ways(NodeId node, Time begin, Time at) const;
    /// Positions of a robot [m] at intervals of `every` > 0, from its first leg until `at`.
    std::vector<Vec3> marks(NodeId node, Time at, Duration every) const;

  private:
    /// Legs (pieces of movement) of a node; empty for a node without records.
    const std::vector<Leg>& legs(NodeId node) const;

    std::vector<std::vector<Leg>> legs_;  // legs by NodeId
};

}  // namespace rovernet
