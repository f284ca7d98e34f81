// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace rovernet {

/// Copy of a message that was lost or not forwarded.
struct LostCopy {
    Time time;
    NodeId robot;                ///< robot where the copy was lost
    std::optional<NodeId> from;  ///< sender of the copy, if the MAC header gives it
    std::string layer, reason;   ///< layer and reason as in the trace
};

/// Robot that received a message, in the tree of first copies.
struct FollowedRobot {
    NodeId robot;
    int depth = 0;               ///< level in the tree; 0: sender of the message
    std::int64_t hops = 0;       ///< number of hops of the first copy, by its TTL
    std::optional<NodeId> from;  ///< robot that transmitted the first copy
    Time time;                   ///< time of the first copy; for the sender, time of sending
    bool is_delivered = false;   ///< true if the robot's application received the message
    std::uint64_t copies = 0;    ///< number of copies received, including the first
    std::vector<Time> on_air;    ///< times at which the robot transmitted the message
};

/// Path of one message through the network.
struct FollowedMessage {
    std::uint64_t uid = 0;
    std::string type;
    NodeId origin;
    std::optional<std::uint32_t> to;  ///< destination of the message; empty for a broadcast
    Time sent;
    std::uint64_t size = 0;  ///< size of the message [bytes]
    std::int64_t ttl = 0;
    std::vector<FollowedRobot> robots;  ///< tree of first copies: a sender before its receivers
    std::vector<LostCopy> lost;         ///< lost copies in the order of the file
    std::vector<NodeId> without;        ///< robots of the trace that received no copy
    Ns2Counts counts;
};

/// Tracer of one message through the events of a trace.
class Ns2Follower {
  public:
    explicit Ns2Follower(std::uint64_t uid) { way_.uid = uid; }

    /// Processes the next event of the trace. From events of other messages only the ids of sent
    /// messages and the numbers of robots are used.
    void take(const Ns2Line& line) {
        std::visit([&](const auto& event) { on(event); }, line);
    }
    /// Adds a robot of the trace that occurs in an event of another message.
    void tell_of(NodeId robot) { robots_.insert(robot.value); }
    /// Path of the message. @throws InputError if no message has this id
    /// @param trace  name of the trace, for the error
    FollowedMessage way(const std::string& trace) const;

  private:
    void on(const Ns2Packet& p);
    void on(const Ns2Move& m) { robots_.insert(m.node.value); }
    template <class Other>
    void on(const Other&) {}
    bool carries(const Ns2Packet& p) const;
    void begin(const Ns2Packet& p);
    void received(const Ns2Packet& p);

    FollowedMessage way_;
    bool is_found_ = false;
    /// TTL of the first frame of the message
    std::optional<std::int64_t> first_ttl_;
    std::map<std::uint32_t, FollowedRobot> by_robot_;
    std::vector<std::uint32_t> order_;  ///< robots in the order of their first copies
    std::set<std::uint32_t> robots_;
    /// smallest id of the messages read before the searched message
    std::optional<std::uint64_t> least_;
    /// largest id of the messages read before the searched message
    std::uint64_t most_ = 0;
};

/// Finds the path of one message through the network, from an ns-2 trace. The message is the first
/// message of an application in the trace whose id is `uid`.
///
/// Robots form a tree by their first copies of the message. The first copy of a robot is its first
/// line `r RTR` or `r AGT` of the message. The sender in the MAC header of this line is the robot's
/// parent in the tree. If protocols forward a message several times, the first copy of a robot may
/// have made more hops than the robot's level in the tree.
/// @throws InputError as read_ns2_trace(), and if no message has this id
FollowedMessage follow_ns2(Ns2Source source, std::uint64_t uid,
                           Ns2Strictness = Ns2Strictness::tolerant);

}  // namespace rovernet
