// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/record.hpp"

#include <vector>

namespace rovernet {

/// Trails of robots, where they have been: a sink that keeps every leg that began.
class Trails {
  public:
    KindMask kinds() const { return kind_of<Moved>(); }
    void on(const Record& record, const RecordContext& context);

    /// Corners of a robot's way until `at`, in order [m]; another way begins where it was put
    /// elsewhere. Empty if it never had a leg.
    std::vector<std::vector<Vec3>> ways(NodeId node, Time at) const;
    /// Positions of a robot at `start`, start + every, ... and until `at` [m]; `every` > 0.
    std::vector<Vec3> marks(NodeId node, Time at, Duration every) const;

  private:
    /// The legs of a node; none for one that was never heard of.
    const std::vector<Leg>& legs(NodeId node) const;

    std::vector<std::vector<Leg>> legs_;  // legs by node
};

}  // namespace rovernet
