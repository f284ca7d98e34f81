// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Client outside that drives robots of a Session.
using ClientId = std::uint32_t;

/// Message that a robot of a client heard.
struct HeardMessage {
    Time time;
    NodeId at;
    NodeId from;  ///< robot that sent it first
    int hops;
    std::string payload;
    friend bool operator==(const HeardMessage&, const HeardMessage&) = default;
};

/// A scenario that is run from outside: in steps, or paced by the clock, while clients drive its
/// robots. A command holds from the time that the session has reached.
class Session {
  public:
    /// @throws InputError for what only shows on the map
    explicit Session(const Scenario& scenario);
    /// Makes a session with settings of network_settings(scenario).
    Session(const Scenario& scenario, NetworkSettings settings);
    /// Ends what its clients hear; the network may live on.
    ~Session();
    Session(const Session&) = delete;  // callbacks of the network refer to it
    Session& operator=(const Session&) = delete;

    Network& network() { return *network_; }
    /// The network, for somebody who keeps it longer than the session.
    std::shared_ptr<Network> shared_network() const { return network_; }
    Time end() const { return end_; }

    /// Runs until `until`, or to the scenario's end if that is earlier.
    /// @throws InputError, RunError
    void step(Time until) { advance(until, every_event); }
    /// Runs to the scenario's end.
    /// @param speed     simulated per real seconds; as fast as possible if not given
    /// @param progress  told the share that is done, 0 ... 1, now and then; false stops it
    /// @return false if it was stopped
    bool run(std::optional<double> speed, const std::function<bool(double)>& progress);

    /// A client takes robots that nobody else drives. @throws std::invalid_argument, naming one
    /// that is taken or listed twice
    ClientId attach(const std::vector<NodeId>& robots);
    /// The client leaves, and all that belongs to it: its robots stand still.
    void detach(ClientId client);

    // Commands, for robots of the client. @throws std::invalid_argument for any other

    /// Drives ahead and turns, as Driven does, until the next command or for `timeout`.
    void drive(ClientId client, NodeId robot, MetersPerSecond speed, RadiansPerSecond turn_rate,
               std::optional<Duration> timeout = {});
    /// Gives a robot any other movement: Waypoints to a goal, Fixed to stand still.
    void move(ClientId client, NodeId robot, Movement movement);
    /// The robot sends to everyone, or over one hop to `to`.
    void send(ClientId client, NodeId robot, std::optional<NodeId> to, std::string payload);

    /// Messages that the client's robots heard since it asked last, in order of time and then of
    /// robot.
    std::vector<HeardMessage> heard(ClientId client);
    /// The robot was told to drive ahead and cannot.
    bool is_stalled(NodeId robot) const;

  private:
    static constexpr std::uint64_t every_event = ~std::uint64_t{0};

    struct Client {
        std::vector<NodeId> robots;
        std::vector<Subscription> subscriptions;
        std::vector<HeardMessage> heard;
    };

    bool advance(Time until, std::uint64_t most_events);
    Client& client_of(ClientId client);
    void check_robot(ClientId client, NodeId robot);

    std::string file_;  // file of the scenario, for errors
    std::shared_ptr<Network> network_;
    Time end_;
    std::map<ClientId, Client> clients_;
    std::map<NodeId, ClientId> drivers_;
    std::map<NodeId, Time> driving_;  // ahead: until when
    ClientId next_client_ = 0;
};

}  // namespace rovernet
