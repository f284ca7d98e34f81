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

/// Inside of a Network: its parts, and the loop that serves their events.
///
/// A message goes down from Applications through Routing and Mac to Channel, which finds who can
/// decode it; from there receptions come up the same way. Motion and LinkMonitor stand beside them.
/// Network is the face that users see: it checks little and passes calls on. docs/inside.md has a
/// picture.
class Engine {
  public:
    /// Makes all parts, and Metrics if the settings want them.
    /// @throws std::invalid_argument if a setting is out of its range
    explicit Engine(NetworkSettings settings);

    /// As the functions of Network of these names; add_sink() also asks the parts for what the sink
    /// wants.
    void reserve(std::size_t robots);
    NodeId add(Robot robot);
    SinkId add_sink(Sink sink);
    /// Switches a robot's radio, in the order that records and protocols rely on: channel, medium,
    /// MAC, record, links, motion, routing. Nothing happens if it is as wanted.
    void switch_robot(NodeId node, bool on);
    /// Serves events up to `end`, in order, at most so many. It begins what has not begun: the run
    /// itself, movements, the watch of links. The clock stands at `end` when all are served.
    /// @return whether `end` is reached; otherwise there are events left
    /// @throws RunError   at the limits of events
    /// @throws StalledRun if the events of a robot do not let time go on
    bool advance(Time end, std::uint64_t most_events);
    /// Checks a robot's id that a user gave.
    /// @throws std::out_of_range if there is no such robot
    NodeId known(NodeId node) const {
        if (node.index() >= world.size()) throw std::out_of_range("there is no such robot");
        return node;
    }

    /// Parts, in the order in which they are made; each keeps references to those that it calls.
    World world;
    Applications applications;
    Routing routing;
    Mac mac;
    Channel channel;
    LinkMonitor links;
    Motion motion;
    /// Names of robots, by their number.
    NameTable names;
    /// Robots that are not there, and why; all of them are off.
    std::map<NodeId, Presence> away;
    /// Metrics of the run, a sink like others; null if the settings want none.
    std::shared_ptr<Metrics> metrics;
    /// Events served so far.
    std::uint64_t served = 0;

  private:
    // Hands an event to the part that it is for.
    void serve(const Event& event);
    // Goes on to the next scene, whose time has come, and tells the parts. Inlined, it would cost
    // serve() some registers with each event.
    [[gnu::noinline]] void change_scene();
    // Facts for sinks that begin now.
    RunInfo run_info() const;
    // Looks at the limits of events and at the growth of time, and when that is needed next.
    void count_events();
    // Counts the next event, while time hardly grows. @throws StalledRun
    void count_next();

    // Number of scheduled events up to which no limit can be reached.
    std::uint64_t check_at_ = 0;
    // Number of scheduled events after which the clock is looked at.
    std::uint64_t look_at_ = Liveness::most_events;
    // A leg lasts 10 ns at least, on average; other events of a robot may be many at a time.
    Liveness legs_{std::chrono::milliseconds(1)}, others_{std::chrono::microseconds(1)};
};

}  // namespace rovernet
