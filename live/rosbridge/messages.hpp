// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/rosbridge/robots.hpp"
#include "live/rosbridge/topic.hpp"
#include "live/rosbridge/writer.hpp"

#include <cstddef>
#include <string>

namespace rovernet {

/// Messages of the topics that this server publishes, as they are at the present time.
///
/// Frames: `map` is the world. NAME/odom is where `map` is, as odometry has no errors here.
/// NAME/base_link is at the robot, with x ahead. A range finder that is elsewhere on the robot, or
/// looks another way, has a frame of its own, NAME/SCANNER_frame.
class RosMessages {
  public:
    /// Both have to live as long.
    RosMessages(Session& session, const RosRobots& robots) : session_(session), robots_(robots) {}

    /// Time between two messages of a topic; 0 if it has none.
    Duration period(const RosTopic& topic) const;
    /// Writes the message of a topic, which is neither an input nor `received`.
    void write(RosWriter& out, const RosTopic& topic) const;
    /// Writes a message that a robot heard, rovernet_msgs/Received.
    void write(RosWriter& out, const HeardMessage& heard) const;

  private:
    Network& network() const { return session_.network(); }
    void write_transforms(RosWriter& out) const;
    void write_static_transforms(RosWriter& out) const;
    void write_map(RosWriter& out) const;
    void write_odometry(RosWriter& out, NodeId robot) const;
    void write_scan(RosWriter& out, NodeId robot, std::size_t number) const;
    std::string scan_frame(NodeId robot, const Scanner& scanner) const;
    void write_neighbors(RosWriter& out, NodeId robot) const;

    Session& session_;
    const RosRobots& robots_;
};

/// Writes a builtin_interfaces/Time.
void write_time(RosWriter& out, Time time);

}  // namespace rovernet
