// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/client_radios.hpp"
#include "experiment/driven_robots.hpp"
#include "experiment/robot_command.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"
#include "scene/scanner.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// A scenario that is run from outside: in steps, or paced by the clock, while clients drive its
/// robots, and send and hear by their radios (ClientRadios). A command holds from the time that the
/// session has reached. The network may live longer than the session: then it has no clients.
class Session {
  public:
    /// @throws InputError for what only shows on the map
    explicit Session(const Scenario& scenario);
    /// Makes a session with settings of network_settings(scenario).
    Session(const Scenario& scenario, NetworkSettings settings);
    Session(const Session&) = delete;  // callbacks of the network refer to it
    Session& operator=(const Session&) = delete;

    Network& network() { return *network_; }
    const Network& network() const { return *network_; }
    /// The network, for somebody who keeps it longer than the session.
    std::shared_ptr<Network> shared_network() const { return network_; }
    /// End of the scenario.
    Time end() const { return end_; }

    /// Runs until `until`, or to the scenario's end if that is earlier.
    /// @throws InputError, RunError
    void step(Time until) { advance(until, every_event); }
    /// Runs like step(), but serves at most so many events. @return whether that time is reached
    bool advance(Time until, std::uint64_t most_events);
    /// Runs to the scenario's end.
    /// @param speed     simulated per real seconds; as fast as possible if not given
    /// @param progress  told the share that is done, 0 ... 1, now and then; false stops it
    /// @return false if it was stopped
    bool run(std::optional<double> speed, const std::function<bool(double)>& progress);

    /// A client takes robots that nobody else drives. Events of the present time are served first,
    /// so that a command comes after all events of its time. @throws std::invalid_argument, naming
    /// one that is taken or listed twice
    /// @param name  of the client, for on_input()
    ClientId attach(const std::vector<NodeId>& robots, std::string name = {});
    /// A client takes part by the radios of robots, whoever drives them: it sends from them and
    /// hears what they hear. Each robot is listed once.
    ClientId attach_radios(const std::vector<NodeId>& robots, std::string name = {});
    /// The client leaves, and all that belongs to it: robots that it drives stand still.
    void detach(ClientId client);

    /// Client that drives the robot, if one does.
    std::optional<ClientId> driver(NodeId robot) const;
    /// Calls `tell` for every command from now on, before it is carried out: together with the
    /// scenario they make the run again. Robots of a client that leaves are told to stop.
    void on_input(std::function<void(const Input&)> tell) { tell_ = std::move(tell); }

    // Commands, for robots of the client; of its radios only to send. @throws std::invalid_argument
    // for any other

    /// Carries out a command, now.
    /// @param number  client's own, for on_input()
    /// @return the message's number, unique in the run, if one was sent: a robot that is off sends
    /// none
    std::optional<std::uint64_t> carry_out(ClientId client, NodeId robot,
                                           const RobotCommand& command, std::uint64_t number = 0);
    /// Drives ahead and turns, as Driven does, until the next command or for `timeout`.
    void drive(ClientId client, NodeId robot, MetersPerSecond speed, RadiansPerSecond turn_rate,
               std::optional<Duration> timeout = {}) {
        carry_out(client, robot, DriveCommand{speed, turn_rate, timeout});
    }
    /// Gives a robot any other movement. It is no command: on_input() is not told of it.
    void move(ClientId client, NodeId robot, Movement movement);
    /// The robot sends to everyone, or over one hop to `to`.
    void send(ClientId client, NodeId robot, std::optional<NodeId> to, std::string payload) {
        carry_out(client, robot, SendCommand{.to = to, .payload = std::move(payload)});
    }

    /// Messages that the client's robots heard since it asked last, in order of time and then of
    /// robot.
    std::vector<HeardMessage> heard(ClientId client);
    /// Says whether messages are kept for heard(), as they are from attach() on: a client that
    /// never asks would fill the memory.
    void set_hearing(ClientId client, bool hears);
    /// The robot was told to drive ahead and cannot.
    bool is_stalled(NodeId robot) const { return driven_.is_stalled(robot); }
    /// Speed of a robot: as it is driven, or else that of its leg.
    Twist twist(NodeId robot) const { return driven_.twist(robot); }

    /// Range finders that the scenario gives to a robot, in its order; they live as long as the
    /// session.
    std::span<const Scanner> range_finders(NodeId robot) const;
    /// Distances that a range finder of a robot measures now [m], one for each beam: to walls, and
    /// to the bodies of other robots. Only a call costs anything.
    /// @param number  of the range finder
    /// @throws std::out_of_range if it has none of that number
    std::vector<double> scan(NodeId robot, std::size_t number = 0) const;

  private:
    static constexpr std::uint64_t every_event = ~std::uint64_t{0};

    /// Client, and the robots that it drives or whose radios it shares.
    struct Client {
        std::string name;
        std::vector<NodeId> robots;
    };

    /// @throws std::invalid_argument if there is no such client
    const Client& client_of(ClientId client) const;
    /// @throws std::invalid_argument unless the client drives the robot
    void check_robot(ClientId client, NodeId robot) const;

    std::string file_;  // file of the scenario, for errors
    std::shared_ptr<Network> network_;
    Time end_;
    DrivenRobots driven_;
    ClientRadios radios_;
    std::map<ClientId, Client> clients_;
    std::map<NodeId, ClientId> drivers_;
    using Scanners = std::shared_ptr<const std::vector<Scanner>>;  // of all robots of a table
    std::map<NodeId, Scanners> range_finders_;
    std::function<void(const Input&)> tell_;
    ClientId next_client_ = 0;
};

}  // namespace rovernet
