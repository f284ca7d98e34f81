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
/// receivers that can decode the message; receptions go up in the reverse order. Motion and
/// LinkMonitor work beside these layers. Network is the public interface and calls these parts.
/// docs/inside/code.md has a picture.
class Engine {
  public:
    /// Creates all parts, and Metrics if the settings enable them.
    /// @throws std::invalid_argument if a setting is out of its range
    explicit Engine(NetworkSettings settings);

    /// These functions implement the functions of Network with the same names. add_sink() also
    /// configures the parts of the network for the records that the sink wants.
    void reserve(std::size_t robots);
    NodeId add(Robot robot);
    SinkId add_sink(Sink sink);
    /// Switches a robot's radio on or off, and notifies the parts in the order that records and
    /// protocols rely on: channel, medium, MAC, record, links, motion, routing. Does nothing if the
    /// radio is already in the state `on`.
    void switch_robot(NodeId node, bool on);
    /// Serves the events up to the time `end`, in order, but at most `most_events` of them. First
    /// starts the run, the movements and the link monitoring, if not yet started. After the last
    /// event up to `end`, the simulated time is `end`, or the later end of this event: receptions
    /// of one frame are one event, which may go on up to `limit`.
    /// @return whether `end` is reached; if not, events up to `end` remain
    /// @throws RunError   at an event limit
    /// @throws StalledRun if the events of a robot follow one another without end while time hardly
    ///         grows
    bool advance(Time end, std::uint64_t most_events, Time limit = start_of_run);
    /// Checks a robot's id passed by the user, and returns the id.
    NodeId known(NodeId node) const {
        if (node.index() >= world.size()) throw std::out_of_range("there is no such robot");
        return node;
    }

    /// Parts of the network in order of construction; each stores references to the parts that it
    /// calls.
    World world;
    Applications applications;
    Routing routing;
    Mac mac;
    Channel channel;
    LinkMonitor links;
    Motion motion;
    /// Names of robots, by id.
    NameTable names;
    /// Robots that are absent, with the reason (not_departed or left); their radios are off.
    std::map<NodeId, Presence> away;
    /// Metrics of the run, computed by a sink; null if the settings disable the metrics.
    std::shared_ptr<Metrics> metrics;
    /// Number of events served so far.
    std::uint64_t served = 0;

  private:
    // Passes an event to the part of the network that serves events of its kind.
    void serve(const Event& event);
    // Replaces the scene by the scene that is due now; notifies LinkMonitor and Motion. Not
    // inlined, because inlining would cost registers in serve().
    [[gnu::noinline]] void change_scene();
    // Description of the run for sinks: scenario, number and names of the robots, seed,
    // replication.
    RunInfo run_info() const;
    // Checks the event limits and the growth of simulated time, and sets check_at_ for the next
    // check.
    void count_events();
    // Counts the next event for its robot, while simulated time hardly grows. @throws StalledRun if
    // the robot has had too many events
    void count_next();

    // Number of scheduled events below which no event limit can be reached.
    std::uint64_t check_at_ = 0;
    // Number of scheduled events at which the growth of simulated time is checked next.
    std::uint64_t look_at_ = Liveness::most_events;
    // Stall detection: 100000 legs of a robot must take at least 1 ms of simulated time (10 ns each
    // on average), 100000 other events of a robot at least 1 us.
    Liveness legs_{std::chrono::milliseconds(1)}, others_{std::chrono::microseconds(1)};
};

}  // namespace rovernet
