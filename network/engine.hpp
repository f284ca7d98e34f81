// SPDX-License-Identifier: MIT
#pragma once

#include "network/applications.hpp"
#include "network/channel.hpp"
#include "network/link_monitor.hpp"
#include "network/mac.hpp"
#include "network/motion.hpp"
#include "network/name_table.hpp"
#include "network/network.hpp"
#include "network/routing.hpp"
#include "network/world.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>

namespace rovernet {

/// What stands behind a Network: its parts, and the loop that serves their events.
///
/// A message goes down from Applications through Routing and Mac to Channel, which finds who can
/// decode it; from there receptions come up the same way. Motion and LinkMonitor stand beside them.
class Engine {
  public:
    /// @throws std::invalid_argument if a setting is out of its range
    explicit Engine(NetworkSettings settings);

    void reserve(std::size_t robots);
    NodeId add(Robot robot);
    SinkId add_sink(Sink sink);
    void switch_robot(NodeId node, bool on);
    bool advance(Time end, std::uint64_t most_events);
    /// @throws std::out_of_range if there is no such robot
    NodeId known(NodeId node) const {
        if (node.index() >= world.size()) throw std::out_of_range("there is no such robot");
        return node;
    }

    World world;
    Applications applications;
    Routing routing;
    Mac mac;
    Channel channel;
    LinkMonitor links;
    Motion motion;
    NameTable names;
    std::map<NodeId, Presence> away;  // robots that are not there: off, and why
    std::shared_ptr<Metrics> metrics;
    std::uint64_t served = 0;  // events

  private:
    void serve(const Event& event);
    RunInfo run_info() const;
    void count_events();

    std::uint64_t check_at_ = 0;  // scheduled events: no limit is reached before
};

}  // namespace rovernet
