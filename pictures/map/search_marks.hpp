// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/robot_marks.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Sink that notes who sent the last request of a routing protocol: the control packet whose kind
/// ends in "REQUEST" that was made last, on all its hops.
class LastSearch {
  public:
    KindMask kinds() const { return kind_of<Transmitted>(); }
    void on(const Record& record, const RecordContext& context);

    /// Notes requests of this robot only.
    void only(NodeId origin) { origin_ = origin; }

    /// Robots that sent the request, in the order of time: the one that made it is the first.
    const std::vector<NodeId>& senders() const { return senders_; }
    /// Search as a sentence: "last request of A: sent by 7 robots from 3.02 s to 3.05 s".
    std::string text(const Network& network) const;

  private:
    std::optional<NodeId> origin_ = std::nullopt;
    std::uint64_t uid_ = 0;  // of the request, if there is one
    NodeId from_{};          // robot that made the request
    Time begin_ = start_of_run, end_ = start_of_run;
    std::vector<NodeId> senders_ = {};
};

/// Leaves room for the rings around the robots that sent the last request, and draws them.
void add_rings(RobotMarks& robots, const LastSearch& search);
void draw_search(Svg& svg, const LastSearch& search, const RobotMarks& robots);
void append_search(Legend& legend);

}  // namespace rovernet
