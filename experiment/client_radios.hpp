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
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Radios of robots, used by clients (external programs) of a Session. A client sends messages from
/// robots, and gets the messages that these robots receive. Several clients may share the radio of
/// a robot. Then each of these clients gets every message that the robot receives.
///
/// Messages are queued for each client until heard() fetches them. A client that never fetches must
/// call set_hearing(), or its queue fills the memory. A robot whose messages are queued for no
/// client costs the network no computing time.
class ClientRadios {
  public:
    /// @param network  must outlive this object
    explicit ClientRadios(Network& network) : network_(network) {}
    /// Stops all clients from receiving messages.
    ~ClientRadios();
    ClientRadios(const ClientRadios&) = delete;  // callbacks of the network refer to this object
    ClientRadios& operator=(const ClientRadios&) = delete;

    /// Adds a client, which gets the messages that `robots` receive from now on.
    /// @param client  id of a client that has not joined yet; identifies the client in other calls
    /// @param robots  robots whose radios the client uses, each listed once; may be empty
    /// @param hears   whether messages are queued for the client, as set_hearing()
    void join(ClientId client, const std::vector<NodeId>& robots, bool hears);
    /// Removes a client and its queued messages. Does nothing if the client has not joined.
    void leave(ClientId client);
    /// Whether a client uses the radio of a robot. True if the robot was in the list `robots` when
    /// the client joined.
    bool has(ClientId client, NodeId robot) const;

    /// Sends a message from a robot, on behalf of any client. This function does not check whether
    /// a client may use the robot's radio.
    /// @return uid of the message, unique in the run; none if the robot is off and sends nothing
    /// @throws std::invalid_argument if the message is for everyone and the network has no routing
    /// protocol
    std::optional<std::uint64_t> send(NodeId robot, const SendCommand& command);

    /// Fetches the messages that were queued for a client since the last call for this client,
    /// sorted by time, then by receiving robot.
    /// @throws std::out_of_range if the client has not joined
    std::vector<HeardMessage> heard(ClientId client);
    /// Sets whether messages are queued for a client until heard() fetches them. If `hears` is
    /// false, queued messages are dropped.
    /// @throws std::out_of_range if the client has not joined
    void set_hearing(ClientId client, bool hears);

  private:
    /// Client of this class: robots whose radios the client uses, and messages queued for the
    /// client.
    struct Client {
        std::vector<NodeId> robots;
        std::vector<HeardMessage> heard = {};
        bool hears = false;
    };
    /// Clients that get the messages received by a robot.
    struct Listeners {
        std::vector<ClientId> clients;
        Subscription subscription;
    };

    void listen(ClientId client, NodeId robot);
    void stop_listening(ClientId client, NodeId robot);
    void hear(NodeId robot, const Heard& heard);

    Network& network_;
    std::map<ClientId, Client> clients_;
    std::map<NodeId, Listeners> listeners_;
};

}  // namespace rovernet
