// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/session.hpp"
#include "live/rosbridge/robots.hpp"
#include "live/rosbridge/topic.hpp"
#include "live/rosbridge/writer.hpp"

#include <cstddef>
#include <string>

namespace rovernet {

/// Writer of the ROS messages of topics to which clients subscribe, for the current simulated time.
///
/// Coordinate frames: `map` is the world. NAME/odom equals `map`, since simulated odometry has no
/// errors. NAME/base_link is at the robot, with x ahead. A range finder with an offset or a
/// rotation on the robot has a separate frame, NAME/SCANNER_frame.
class RosMessages {
  public:
    /// Session and robots must outlive this object.
    RosMessages(Session& session, const RosRobots& robots) : session_(session), robots_(robots) {}

    /// Interval between messages of a topic; 0 if the topic is not periodic.
    Duration period(const RosTopic& topic) const;
    /// Writes the message of a topic for the current time. @param topic  topic to which clients
    /// subscribe, except radio/received: see write(RosWriter&, const HeardMessage&)
    void write(RosWriter& out, const RosTopic& topic) const;
    /// Writes a radio message that a robot received, as ROS type rovernet_msgs/Received.
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

/// Writes a time as ROS type builtin_interfaces/Time.
void write_time(RosWriter& out, Time time);

}  // namespace rovernet
