// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "network/network.hpp"
#include "scenario/document/value.hpp"

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

class ClientRadios;
class DrivenRobots;
class ScenarioFile;
struct Scanner;
struct Scenario;

/// Run of a scenario that clients (external programs) control. The run advances in steps, or paced
/// by the clock. Clients drive robots, and send and receive messages by robots' radios
/// (ClientRadios). A command takes effect at the current simulated time. The network may outlive
/// the session. Then the network has no clients.
/// Example: examples/session.cpp.
class Session {
  public:
    /// Makes the network. @throws InputError for errors found with the map: a robot in a wall, say
    /// @param router  routing protocol in place of the scenario's protocol
    explicit Session(const Scenario& scenario, std::optional<Router> router = {});
    /// Makes a session of a scenario file, overridden by `settings` (values by path, as in --set).
    /// Example with a routing protocol of the program: examples/router.cpp.
    explicit Session(const ScenarioFile& file, const Table& settings = {},
                     std::optional<Router> router = {});
    /// Makes a session whose network has the given settings, as from network_settings(scenario).
    Session(const Scenario& scenario, NetworkSettings settings, std::optional<Router> router = {});
    ~Session();
    Session(const Session&) = delete;  // callbacks of the network refer to this object
    Session& operator=(const Session&) = delete;

    Network& network() { return *network_; }
    const Network& network() const { return *network_; }
    /// Network with shared ownership, for callers that need it after the session has ended.
    std::shared_ptr<Network> shared_network() const { return network_; }
    /// Simulated time at which the scenario ends.
    Time end() const { return end_; }

    /// Runs until the time `until`, or until the end of the scenario if that is earlier. Receptions
    /// of one frame are processed together up to the time `limit`, even if they are later than
    /// `until`, so that the records do not depend on `until`.
    /// @throws InputError, RunError
    void step(Time until, Time limit = start_of_run) { advance(until, every_event, limit); }
    /// Runs like step(), but processes at most `most_events` events. @return whether the time
    /// `until` was reached
    bool advance(Time until, std::uint64_t most_events, Time limit = start_of_run);
    /// Runs to the end of the scenario.
    /// @param speed     ratio of simulated time to real time [-]; none: as fast as possible
    /// @param progress  called repeatedly with the finished share, 0 ... 1; returning false stops
    /// the run
    /// @return false if the run was stopped
    bool run(std::optional<double> speed, const std::function<bool(double)>& progress);

    /// Adds a client that drives `robots`, which no other client may drive. Events of the current
    /// time are processed first, so that a command takes effect after all events of its time.
    /// @throws std::invalid_argument that names a robot that another client drives or is listed
    /// twice
    /// @param name   name of the client, for on_input()
    /// @param hears  whether messages are queued for heard(), as set_hearing()
    ClientId attach(const std::vector<NodeId>& robots, std::string name = {}, bool hears = true);
    /// Adds a client that uses the radios of `robots` without driving the robots. The client sends
    /// messages from these robots, and gets the messages received by these robots. Each robot is
    /// listed once.
    ClientId attach_radios(const std::vector<NodeId>& robots, std::string name = {},
                           bool hears = true);
    /// Removes a client and its queued messages. Robots that the client drives stop.
    void detach(ClientId client);

    /// Client that drives the robot; none if no client drives the robot.
    std::optional<ClientId> driver(NodeId robot) const;
    /// Sets a callback `tell`, called for every command of a client before the command is executed.
    /// The scenario and these commands reproduce the run. The commands include a StopCommand for
    /// each robot that a leaving client drives.
    void on_input(std::function<void(const Input&)> tell) { tell_ = std::move(tell); }

    // A client may command the robots that it drives. It may also give SendCommands to the robots
    // whose radios it uses. The functions below throw std::invalid_argument for any other robot.

    /// Executes a command of a client now.
    /// @param number  number that the client gave to the command, for on_input()
    /// @return uid of the sent message, unique in the run; none: no message was sent, since the
    /// command is no SendCommand or the robot is off
    std::optional<std::uint64_t> carry_out(ClientId client, NodeId robot,
                                           const RobotCommand& command, std::uint64_t number = 0);
    /// Makes a robot drive ahead and turn (see Driven), until the next command, or until `timeout`
    /// [ns] has passed.
    void drive(ClientId client, NodeId robot, MetersPerSecond speed, RadiansPerSecond turn_rate,
               std::optional<Duration> timeout = {}) {
        carry_out(client, robot, DriveCommand{speed, turn_rate, timeout});
    }
    /// Gives a robot any movement. The callback of on_input() is not called for this movement.
    void move(ClientId client, NodeId robot, Movement movement);
    /// Sends a message from a robot to the robot `to` (none: to all robots), see Network::send.
    void send(ClientId client, NodeId robot, std::optional<NodeId> to, std::string payload) {
        carry_out(client, robot, SendCommand{.to = to, .payload = std::move(payload)});
    }

    /// Fetches the messages that the client's robots received since the client's last call, sorted
    /// by time, then by receiving robot.
    std::vector<HeardMessage> heard(ClientId client);
    /// Sets whether messages are queued for a client until heard() fetches them. A client that
    /// never calls heard() should set false, or its queue fills the memory.
    void set_hearing(ClientId client, bool hears);
    /// Whether the robot stands still although its command is to drive ahead, since an obstacle
    /// (such as a wall) blocks the robot.
    bool is_stalled(NodeId robot) const;
    /// Whether the robot stands still since no path reaches the goal of its command.
    bool has_no_way(NodeId robot) const;
    /// Sentence that explains why a robot cannot carry out a command; empty if the robot can. There
    /// are three reasons: a GoalCommand to a position [m] off the map, which no path reaches; a
    /// PlaceCommand to a position at which the robot does not fit: off the map, in a wall, or
    /// nearer to a wall than the robot's radius; a SendCommand to the robot itself.
    std::string why_not(NodeId robot, const RobotCommand& command) const;
    /// Velocity of a robot in the robot's coordinate frame: the commanded velocity while a drive
    /// command is active; otherwise the velocity of the current leg (piece of movement).
    Twist twist(NodeId robot) const;

    /// Range finders of a robot, in the order of the scenario; valid as long as the session.
    std::span<const Scanner> range_finders(NodeId robot) const;
    /// Distances [m] from a range finder of a robot to the nearest wall or other robot at the
    /// current time, one distance for each beam. They are computed only when this function is
    /// called.
    /// @param number  index of the range finder, from 0
    /// @throws std::out_of_range if the robot has no such range finder
    std::vector<double> scan(NodeId robot, std::size_t number = 0) const;

  private:
    static constexpr std::uint64_t every_event = ~std::uint64_t{0};

    /// Client: its name, and the robots that the client drives or whose radios the client uses.
    struct Client {
        std::string name;
        std::vector<NodeId> robots;
    };

    /// Client with the given id. @throws std::invalid_argument if no client has this id
    const Client& client_of(ClientId client) const;
    /// Checks that the client drives the robot. @throws std::invalid_argument if it does not
    void check_robot(ClientId client, NodeId robot) const;
    std::string why_not_at(NodeId robot, Vec3 at) const;

    std::string file_;  // path of the scenario file, for error messages
    std::shared_ptr<Network> network_;
    Time end_;
    std::unique_ptr<DrivenRobots> driven_;
    std::unique_ptr<ClientRadios> radios_;
    std::map<ClientId, Client> clients_;
    std::map<NodeId, ClientId> drivers_;
    // Range finders shared by all robots of one [[robot]] table of the scenario.
    using Scanners = std::shared_ptr<const std::vector<Scanner>>;
    std::map<NodeId, Scanners> range_finders_;
    std::function<void(const Input&)> tell_;
    ClientId next_client_ = 0;
};

}  // namespace rovernet
