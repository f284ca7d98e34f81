// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/movement.hpp"
#include "network/neighbour.hpp"
#include "network/robot.hpp"
#include "network/settings.hpp"
#include "network/subscription.hpp"
#include "sim/ids.hpp"
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

/// Options of a message that its sender chooses.
struct SendOptions {
    /// Size on air [bytes], without the bytes that the access model adds; the payload's length if
    /// not given.
    std::optional<std::uint32_t> size = {};
    /// Number of the message's flow, from 1; 0 for no flow.
    std::uint32_t flow = 0;
    /// Port, which selects a program of the receiver; 0 for none.
    std::uint16_t port = 0;
    /// True: the message is sent over one hop, without the routing protocol.
    bool one_hop = false;
};

/// Number of a sink in a Network, for remove_sink().
using SinkId = std::uint32_t;

class Engine;
class Legs;
class Medium;

/// Simulated world of robots, their radios and their messages: the main class of the library.
///
///   Network network({.seed = 1});
///   const NodeId a = network.add({.name = "A", .at = {0, 0}});
///   network.add({.name = "B", .at = {80, 0}});
///   network.route(Flood{.ttl = 3});
///   network.at(start_of_run + 1s, [&] { network.send(a, everyone, "hello"); });
///   network.run_for(10s);
///
/// Two Networks in one process never interact. A Network is not thread-safe: use one per thread.
/// Examples: examples/hello.cpp, examples/failures.cpp.
class Network {
  public:
    /// @throws std::invalid_argument if a setting is out of its range
    explicit Network(NetworkSettings settings = {});
    ~Network();
    Network(const Network&) = delete;  // callbacks refer to the Network
    Network& operator=(const Network&) = delete;

    /// Reserves memory for `robots` robots in total, which avoids the overhead of gradual growth.
    void reserve(std::size_t robots);
    /// Adds a robot, switched on. Its movement begins with the run, or now if the run has begun.
    /// @throws std::invalid_argument for a name in use or a parameter out of its range
    NodeId add(Robot robot);
    /// Sets the routing protocol of all robots. @throws std::invalid_argument if already set
    void route(Router router);
    /// Adds a sink, which gets every record of its kinds from now on. The sink's begin() is called
    /// at the start of the run, or now if the run has begun.
    SinkId add_sink(Sink sink);
    /// Removes a sink: the sink gets no more records, and its finish() is not called. It is an
    /// error to call remove_sink() inside a sink.
    void remove_sink(SinkId sink);

    /// Sends a message from `from` to `to`, a robot or `everyone`. Every routing protocol forwards
    /// messages to everyone; a protocol with the trait routes_unicasts also forwards messages to
    /// one robot. All other messages go over one hop: the access model "csma" retransmits a message
    /// to one robot until an acknowledgement or the retry limit.
    /// @return uid of the message, unique in the run; empty if `from` is off and sends nothing
    /// @throws std::invalid_argument if `to` is `from` or no robot; or without a routing protocol,
    ///         for a message to everyone that is not limited to one hop
    std::optional<std::uint64_t> send(NodeId from, NodeId to, std::string payload,
                                      SendOptions options = {});
    /// Starts saturated traffic: from now on `node` always has another message of `size` [bytes],
    /// with this payload, to send to `to`, or to everyone, over one hop.
    /// @throws std::invalid_argument without an access model, because sending would be unlimited
    void saturate(NodeId node, NodeId to, std::uint32_t size, std::uint32_t flow = 0,
                  std::string payload = {});
    // Callbacks: each callback is called until its Subscription is ended.

    /// Calls `react` whenever a message is delivered to `node`, 1 us after its reception.
    /// Example: examples/reactions.cpp.
    Subscription on_receive(NodeId node, std::function<void(const Message&)> react);
    Subscription on_receive(NodeId node, std::function<void(const Heard&)> react,
                            HearOptions options = {});
    /// Calls `react` 1 us after each time that `node` ends a movement and rests.
    Subscription on_arrival(NodeId node, std::function<void()> react);
    /// Calls `react(from)` 1 us after `node` has lost the link from `from`, and cannot hear it any
    /// more. Link monitoring costs a search whenever a robot begins a new leg.
    Subscription on_link_lost(NodeId node, std::function<void(NodeId from)> react);
    /// Replaces the node's movement by `movement`, which begins now.
    void move(NodeId node, Movement movement);
    /// Moves a robot immediately to the position `at` [m], where it rests; its movement ends.
    /// @param heading  heading at the new position [rad]; unchanged if not given
    void place(NodeId node, Vec3 at, std::optional<Radians> heading = {});
    /// Stops a robot at its position; its movement ends.
    void stop(NodeId node);
    /// Sets the bit rate of a robot's radio, and with it the coding of its frames, from now on.
    /// @throws std::invalid_argument if the reception model cannot judge frames at this rate
    void set_rate(NodeId node, BitRate rate);
    /// Switches a robot off: the robot stops, and its radio neither transmits nor receives.
    void switch_off(NodeId node);
    /// Switches a robot off and marks the robot as absent until switch_on().
    /// @param why  reason of the absence: not_departed or left
    void take_away(NodeId node, Presence why);
    /// Switches a robot on: the robot continues its movement. Does nothing if the robot is on.
    void switch_on(NodeId node);

    /// Calls `action` at `time`.
    /// @throws std::invalid_argument if `time` is before now()
    Subscription at(Time time, std::function<void()> action);
    /// Calls `action` every `period` > 0 from now() + period on.
    /// @throws std::invalid_argument unless 0 s < period <= 1e9 s
    Subscription every(Duration period, std::function<void()> action);

    /// Runs until `end`, including events at `end`.
    /// @throws RunError at the event limit
    void run_until(Time end);
    void run_for(Duration d) { run_until(now() + d); }
    /// Runs like run_until(), but serves at most `most_events`, for callers that have other work in
    /// between. Receptions of one frame are not separated by `end`, but by `limit`, if it is
    /// later: now() may then be after `end`. @return whether `end` is reached
    bool advance(Time end, std::uint64_t most_events, Time limit = start_of_run);

    /// Ends the run, then calls finish() of all sinks. A message is recorded as dropped ("END") if
    /// none of its frames has ended at a receiver. metrics() excludes these messages, except
    /// messages that the routing protocol still holds. Call once, after the last run_until().
    /// @throws std::logic_error in a debug build if the protocol still holds messages that it does
    ///         not keep
    void finish();

    /// Simulated time: time of the current event, or the end of the last run.
    Time now() const;
    Time next_event() const;              ///< time of the next event; `never` if there is none
    std::size_t size() const;             ///< number of robots
    std::uint64_t events() const;         ///< number of events served so far
    std::uint64_t transmissions() const;  ///< number of frames transmitted so far
    /// Upper bound [dB] on the reduction of any SINR so far by frames that the reception model
    /// `sinr` neglected (Sinr::interference_cut). The bound assumes that all frames on air come
    /// from just beyond the cut-off. Empty if no frames are neglected.
    std::optional<Db> interference_left_out() const;
    /// Name of a robot. @throws std::out_of_range if there is no such robot
    std::string name(NodeId node) const;
    /// Robot with the name `name`; empty if there is none.
    std::optional<NodeId> find(std::string_view name) const;
    /// Current position of a robot [m].
    Vec3 position(NodeId node) const;
    /// Current heading of a robot [rad], -pi ... pi.
    Radians heading(NodeId node) const;
    /// Neighbours that `node` hears at `t` >= now(), if all robots stay on their current legs; in
    /// order of id.
    std::vector<Neighbour> links(NodeId node, Time t) const;
    /// Routing table of a robot now, in the order of destinations; empty if the protocol has none.
    std::vector<RouteState> routes(NodeId node) const;
    std::string routing_notice() const;  ///< notice of the protocol, see HasNotice; or empty
    /// Current path loss [dB] from `from` to `to`, with shadowing, without the antennas' gains.
    /// Example: examples/walls.cpp.
    Db path_loss(NodeId from, NodeId to) const;
    /// Appends to `out` the nodes that would hear `node` if `node` transmitted now, in any order.
    void find_hearers(NodeId node, std::vector<NodeId>& out);
    /// Number of movements that a robot was given so far: by move(), place() and stop().
    std::uint32_t movements(NodeId node) const;
    /// Current state of a robot.
    RobotState robot(NodeId node) const;
    /// Settings passed to the constructor; below, current legs of all robots.
    const NetworkSettings& settings() const;
    const Legs& legs() const;
    /// Radio medium, which stores radios and propagation models; below, current scene.
    const Medium& medium() const;
    const Scene& scene() const;
    /// Planners of paths around the scene's walls.
    Planners& planners();
    /// Metrics so far. @throws std::invalid_argument if settings.metrics is off
    MetricValues metrics() const;
    /// Sum [ns] of the airtimes of all frames so far, without frames that began in the warm-up.
    Duration airtime() const;

  private:
    std::unique_ptr<Engine> engine_;
};

/// Robot with this name. @throws std::invalid_argument, with some existing names, if there is none
NodeId robot_named(const Network& network, const std::string& name);

}  // namespace rovernet
