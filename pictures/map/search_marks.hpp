// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "pictures/draw/legend.hpp"
#include "pictures/draw/svg.hpp"
#include "pictures/map/robot_marks.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Sink that stores the robots that sent the last route request: its originator, and the robots
/// that forwarded it. A request is a control packet of a routing protocol whose kind ends in
/// "REQUEST". A robot may forward a request as a new packet, with its own address (DSR) or a newer
/// number (AODV): originator and number in the packet tell to which request the packet belongs. A
/// packet of any other protocol is a request of its own.
class LastSearch {
  public:
    KindMask kinds() const { return kind_of<Transmitted>(); }
    void on(const Record& record, const RecordContext& context);

    /// Restricts the sink to requests whose origin is the robot `origin`.
    void only(NodeId origin) { origin_ = origin; }

    /// Robots that sent the last request, in order of time. The origin of the request is the first.
    const std::vector<NodeId>& senders() const { return senders_; }
    /// Sentence about the request:
    /// "last route request of A: sent by 7 robots from 3.02 s to 3.05 s".
    std::string text(const Network& network) const;

  private:
    /// Request of a packet: its originator, and the request's number; of a protocol that is not
    /// known here, the packet's uid.
    using Request = std::pair<NodeId, std::uint64_t>;
    static Request request_of(const Message& message);

    std::optional<NodeId> origin_ = std::nullopt;
    std::optional<Request> last_ = std::nullopt;  // last request of origin_
    Time begin_ = start_of_run, end_ = start_of_run;
    std::vector<NodeId> senders_ = {};
};

/// Leaves room for rings around the robots that sent the last request; draw_search() draws the
/// rings.
void add_rings(RobotMarks& robots, const LastSearch& search);
void draw_search(Svg& svg, const LastSearch& search, const RobotMarks& robots);
void append_search(Legend& legend);

}  // namespace rovernet
