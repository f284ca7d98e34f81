// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "network/neighbour.hpp"
#include "network/robot.hpp"
#include "network/settings.hpp"
#include "network/subscription.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/router.hpp"
#include "sim/sink.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// Way of a message to the node that is handed it.
struct Heard {
    /// Hops that it crossed.
    int hops;
};

/// Number of a sink of a Network, to remove it by.
using SinkId = std::uint32_t;

class Engine;
class Medium;

/// Robots, their radios and what they say to each other, in one simulated world. It is the face of
/// the library:
///
///   Network network({.seed = 1});
///   const NodeId a = network.add({.name = "A", .at = {0, 0}});
///   network.add({.name = "B", .at = {80, 0}});
///   network.route(Flood{.ttl = 3});
///   network.at(start_of_run + 1s, [&] { network.broadcast(a, "hello"); });
///   network.run_for(10s);
///
/// Two Networks in one process never interact. Not thread-safe; each thread runs its own.
class Network {
  public:
    /// @throws std::invalid_argument if a setting is out of its range
    explicit Network(NetworkSettings settings = {});
    ~Network();
    Network(const Network&) = delete;  // actions and reactions refer to it
    Network& operator=(const Network&) = delete;

    /// Makes room for `robots` robots in all: spares the memory that growing step by step would
    /// leave.
    void reserve(std::size_t robots);
    /// Adds a robot, switched on. Its movement begins now.
    /// @throws std::invalid_argument for a name that is taken or a parameter out of its range
    NodeId add(Robot robot);
    /// Gives all robots their routing protocol. @throws std::invalid_argument if there is one
    void route(Router router);
    /// Adds a sink: every record of the kinds that it asks for reaches it from now on. It begins
    /// with the run, or now if that has begun.
    SinkId add_sink(Sink sink);
    /// Adds a sink, under the name that says what it is for: net.trace_to(Ns2Trace{"run.tr"}).
    SinkId trace_to(Sink sink) { return add_sink(std::move(sink)); }
    /// Removes a sink: it gets no more records, and is not finished. Not from within a sink.
    void remove_sink(SinkId sink);

    /// Sends a message from `node` to everyone. A node that is off says nothing.
    /// @param size  on air [bytes]; the payload's length if not given
    /// @param flow  flow that the message belongs to, from 1; 0: none
    /// @throws std::invalid_argument if no protocol is set
    void broadcast(NodeId node, std::string payload, std::optional<std::uint32_t> size = {},
                   std::uint32_t flow = 0);
    /// Sends a message from `node` to `to` by the routing protocol. Parameters as for broadcast().
    /// @throws std::invalid_argument if no protocol is set, or it brings messages to everyone only
    void send(NodeId node, NodeId to, std::string payload, std::optional<std::uint32_t> size = {},
              std::uint32_t flow = 0);
    /// Sends a message from `node` to `to`, or to `everyone` that hears it, over one hop, without
    /// routing: the access model "csma" repeats a message to one robot until it is acknowledged or
    /// given up. Parameters as for broadcast().
    void unicast(NodeId node, NodeId to, std::string payload,
                 std::optional<std::uint32_t> size = {}, std::uint32_t flow = 0);
    /// Keeps `node` sending messages of `size` [bytes] to `to`, or to everyone, over one hop: from
    /// now on there is always one more.
    /// @throws std::invalid_argument without an access model: nothing would hold it back
    void saturate(NodeId node, NodeId to, std::uint32_t size, std::uint32_t flow = 0);
    // Callbacks: each is called until its Subscription is ended.

    /// Calls `react` whenever `node` is handed a message, 1 us after it was received.
    Subscription on_receive(NodeId node, std::function<void(const Message&)> react);
    Subscription on_receive(NodeId node, std::function<void(const Message&, const Heard&)> react);
    /// Calls `react` whenever `node` comes to rest at the end of a movement, 1 us later.
    Subscription on_arrival(NodeId node, std::function<void()> react);
    /// Calls `react(from)` whenever `node` cannot hear `from` any more, 1 us later. Watching links
    /// costs a search whenever a robot begins a new leg.
    Subscription on_link_lost(NodeId node, std::function<void(NodeId from)> react);
    /// Replaces the node's movement, now.
    void move(NodeId node, Movement movement);
    /// Puts a robot somewhere else at once, at rest; its movement is over.
    /// @param heading  that it has there [rad]; as before if not given
    void place(NodeId node, Vec3 at, std::optional<Radians> heading = {});
    /// Stops a robot where it is; its movement is over.
    void stop(NodeId node);
    /// Switches a robot off: it stops, its radio is silent and deaf.
    void switch_off(NodeId node);
    /// Switches a robot off that is not there.
    /// @param why  not_departed or left; switch_on() brings it
    void take_away(NodeId node, Presence why);
    /// Switches a robot on again: it goes on. Nothing happens if it is on.
    void switch_on(NodeId node);

    /// Calls `action` at `time`.
    /// @throws std::invalid_argument if that is before now()
    Subscription at(Time time, std::function<void()> action);
    /// Calls `action` every `period` > 0 from now() + period on.
    /// @throws std::invalid_argument for a period that is not > 0 s, or above 1e9 s
    Subscription every(Duration period, std::function<void()> action);

    /// Runs until `end`, events at `end` included.
    /// @throws RunError at the event limit
    void run_until(Time end);
    void run_for(Duration d) { run_until(now() + d); }
    /// Runs like run_until, but serves at most `most_events`: for callers that have to look up in
    /// between.
    /// @return whether `end` is reached
    bool advance(Time end, std::uint64_t most_events);

    /// Ends the run: messages that are still at their senders are told of as dropped ("END"), so
    /// that metrics() can leave them out; then the sinks finish. Once, after the last run_until().
    void finish();

    /// Time of the simulation: that of the event that is served, or where the last run ended.
    Time now() const;
    /// Time of the event that is served next; `never` if there is none.
    Time next_event() const;
    /// Number of robots.
    std::size_t size() const;
    /// Events served so far.
    std::uint64_t events() const;
    /// Frames put on air so far.
    std::uint64_t transmissions() const;
    /// Bound on what the frames that `sinr` left out (Sinr::interference_cut) would have taken off
    /// a signal to interference ratio so far, if all on air anywhere came from just beyond the cut.
    std::optional<Db> interference_left_out() const;
    /// Name of a robot. @throws std::out_of_range if there is no such robot
    std::string name(NodeId node) const;
    /// Robot of that name, if there is one.
    std::optional<NodeId> find(std::string_view name) const;
    /// Position now [m].
    Vec3 position(NodeId node) const;
    /// Heading now [rad], -pi ... pi.
    Radians heading(NodeId node) const;
    /// Neighbours that `node` hears at `t` >= now(), everybody on the leg that they are on now; in
    /// order of id.
    std::vector<Neighbour> links(NodeId node, Time t) const;
    /// Appends to `out` the nodes that would hear `node` if it sent now, in no order to rely on.
    void find_hearers(NodeId node, std::vector<NodeId>& out);
    /// State of a robot now.
    RobotState robot(NodeId node) const;
    /// Settings as they were given, legs of all robots, the medium and the scene.
    const NetworkSettings& settings() const;
    const Legs& legs() const;
    /// Medium, which knows radios and models.
    const Medium& medium() const;
    const Scene& scene() const;
    /// Planners of ways around the scene's walls.
    Planners& planners();
    /// Metrics so far. @throws std::invalid_argument if settings.metrics is off
    MetricValues metrics() const;

  private:
    std::unique_ptr<Engine> engine_;
};

}  // namespace rovernet
