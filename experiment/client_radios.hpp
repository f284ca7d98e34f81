// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/robot_command.hpp"
#include "network/network.hpp"
#include "network/subscription.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Client outside that takes part in a Session.
using ClientId = std::uint32_t;

/// Message that a robot of a client heard.
struct HeardMessage {
    Time time;    ///< at which the robot was handed it, 1 us after the frame was received
    NodeId at;    ///< robot that heard it
    NodeId from;  ///< robot that sent it first
    int hops;     ///< that it crossed, from 1
    std::string payload;
    NodeId last_hop = {};           ///< robot whose frame it was
    std::optional<Dbm> level = {};  ///< level of that frame here [dBm]; none: on its way already
                                    ///< when the first client came
    std::uint16_t port = 0;         ///< as it was sent by a client; 0: none was given
    bool is_for_everyone = true;    ///< otherwise it was sent to `at`
    friend bool operator==(const HeardMessage&, const HeardMessage&) = default;
};

/// Radios by which clients of a Session take part: clients send from robots, and hear what these
/// hear. Several clients may share the radio of a robot; each of them hears every message.
///
/// Messages are kept for each client until it asks for them: one that never asks has to say so by
/// set_hearing(), or they fill the memory.
///
/// A callback of a network tells neither the number of a message nor whose frame brought it at what
/// level. A sink notes these from the records Sent and Received. It is added as the first client
/// joins, so that a network without clients costs nothing more.
class ClientRadios {
  public:
    /// @param network  has to live as long, and may live longer
    explicit ClientRadios(Network& network) : network_(network) {}
    /// Ends what the clients hear.
    ~ClientRadios();
    ClientRadios(const ClientRadios&) = delete;  // callbacks of the network refer to it
    ClientRadios& operator=(const ClientRadios&) = delete;

    /// A client hears what robots hear, from now on.
    /// @param client  has not joined yet, and names itself in all calls below
    /// @param robots  each listed once; may be empty
    void join(ClientId client, const std::vector<NodeId>& robots);
    /// A client leaves, and messages that were kept for it are gone.
    /// @param robots  those with which it joined
    void leave(ClientId client, const std::vector<NodeId>& robots);
    /// Whether a client joined with that robot, and has not left.
    bool has(ClientId client, NodeId robot) const;

    /// A robot sends a message, on behalf of any client: who may use its radio is not checked.
    /// Some client has joined before.
    /// @return the message's number, unique in the run; none if the robot is off and sends nothing
    /// @throws std::invalid_argument if the message is for everyone and there is no protocol
    std::optional<std::uint64_t> send(NodeId robot, const SendCommand& command);

    /// Messages that a client heard since it asked last, in order of time and then of robot.
    /// @throws std::out_of_range if it has not joined
    std::vector<HeardMessage> heard(ClientId client);
    /// Says whether messages are kept for heard(), as they are from join() on. What was kept before
    /// a client stops hearing is gone. @throws std::out_of_range if it has not joined
    void set_hearing(ClientId client, bool hears);

  private:
    class Ears;
    /// Messages that are kept for a client.
    struct Inbox {
        std::vector<HeardMessage> heard = {};
        bool hears = true;
    };
    /// Clients who hear what a robot hears.
    struct Listeners {
        std::vector<ClientId> clients;
        Subscription subscription;
    };

    void listen(ClientId client, NodeId robot);
    void stop_listening(ClientId client, NodeId robot);
    void hear(NodeId robot, const Message& message, const Heard& how);

    Network& network_;
    std::map<ClientId, Inbox> inboxes_;
    std::map<NodeId, Listeners> listeners_;
    std::shared_ptr<Ears> ears_;  // null until a client joins
};

}  // namespace rovernet
