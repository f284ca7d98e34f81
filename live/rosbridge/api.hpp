// SPDX-License-Identifier: MIT
#pragma once

#include "live/rosbridge/request.hpp"
#include "live/rosbridge/writer.hpp"

namespace rovernet {

/// Services of the ROS package rosapi, by which ROS clients list topics, services and nodes. There
/// is one node, rovernet, with all topics and services.
class RosApi {
  public:
    /// @param session  must outlive this object
    explicit RosApi(Session& session) : session_(session) {}

    /// Writes the result of a call of a rosapi service, as an object.
    void write(RosWriter& out, const RosCall& call) const;

  private:
    enum class Direction { in, out, both };

    /// Writes a list of topic names under `key`: topics of the given direction (in: clients
    /// publish; out: clients subscribe) and message type. An empty type matches all topics.
    void write_topics(RosWriter& out, std::string_view key, Direction direction,
                      std::string_view type = {}) const;
    void write_types(RosWriter& out) const;
    void write_services(RosWriter& out, std::string_view type = {}) const;
    void write_parameter(RosWriter& out, const std::string& name) const;
    void write_raw_types(RosWriter& out) const;
    void write_node(RosWriter& out, const std::string& node) const;
    void write_users(RosWriter& out, std::string_view key, const std::string& topic,
                     bool is_input) const;

    Session& session_;
};

}  // namespace rovernet
