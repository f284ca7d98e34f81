// SPDX-License-Identifier: MIT
#pragma once

#include "network/applications.hpp"
#include "network/channel.hpp"
#include "network/link_monitor.hpp"
#include "network/liveness.hpp"
#include "network/mac.hpp"
#include "network/motion.hpp"
#include "network/name_table.hpp"
#include "network/network.hpp"
#include "network/routing.hpp"
#include "network/world.hpp"
#include "traces/metrics.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>

namespace rovernet {

/// Implementation of a Network: its parts, and the event loop.
///
/// A message goes down from Applications through Routing and Mac to Channel, which finds the
/// receivers that can decode it; receptions go up in the reverse order. Motion and LinkMonitor work
/// beside these layers. Network is the public interface: it passes calls on to the parts.
/// docs/inside.md has a picture.
class Engine {
  public:
    /// Creates all parts, and Metrics if the settings enable them.
    /// @throws std::invalid_argument if a setting is out of its range
    explicit Engine(NetworkSettings settings);

    /// Functions of Network with the same names; add_sink() also configures the parts for the
    /// records that the sink wants.
    void reserve(std::size_t robots);
    NodeId add(Robot robot);
    SinkId add_sink(Sink sink);
    /// Switches a robot's radio, in the order that records and protocols rely on: channel, medium,
    /// MAC, record, links, motion, routing. Does nothing if the radio is already in that state.
    void switch_robot(NodeId node, bool on);
    /// Serves events up to `end`, in order, at most `most_events`. It first starts everything that
    /// has not started: the run, movements, link monitoring. The clock is at `end` when all are
    /// served.
    /// @return whether `end` is reached; if not, events are left
    /// @throws RunError   at an event limit
    /// @throws StalledRun if the events of a robot stop the clock
    bool advance(Time end, std::uint64_t most_events);
    /// Checks a robot's id passed by the user.
    /// @throws std::out_of_range if there is no such robot
    NodeId known(NodeId node) const {
        if (node.index() >= world.size()) throw std::out_of_range("there is no such robot");
        return node;
    }

    /// Parts in order of construction; each stores references to the parts that it calls.
    World world;
    Applications applications;
    Routing routing;
    Mac mac;
    Channel channel;
    LinkMonitor links;
    Motion motion;
    /// Names of robots, by id.
    NameTable names;
    /// Robots that are absent (not departed or left), and the reason; all are off.
    std::map<NodeId, Presence> away;
    /// Metrics of the run, which are a sink; null if the settings disable them.
    std::shared_ptr<Metrics> metrics;
    /// Number of events served so far.
    std::uint64_t served = 0;

  private:
    // Passes an event to its part.
    void serve(const Event& event);
    // Changes to the next scene, which is due, and notifies the parts. Not inlined, which would
    // cost registers in serve().
    [[gnu::noinline]] void change_scene();
    // Facts for sinks that begin now.
    RunInfo run_info() const;
    // Checks the event limits and the growth of time, and sets when the next check is due.
    void count_events();
    // Counts the next event while time hardly grows. @throws StalledRun
    void count_next();

    // Number of scheduled events below which no limit can be reached.
    std::uint64_t check_at_ = 0;
    // Number of scheduled events at which the clock is checked next.
    std::uint64_t look_at_ = Liveness::most_events;
    // Stall detection for legs (at least 10 ns each on average) and for other events.
    Liveness legs_{std::chrono::milliseconds(1)}, others_{std::chrono::microseconds(1)};
};

}  // namespace rovernet
