// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/time.hpp"
#include "traces/ns2/ns2_file.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// A copy of a message that went no further.
struct LostCopy {
    Time time;
    NodeId robot;                ///< where it was lost
    std::optional<NodeId> from;  ///< who sent it, if a MAC says so
    std::string layer, reason;   ///< as in the trace
};

/// A robot on the way of a message.
struct FollowedRobot {
    NodeId robot;
    int depth = 0;               ///< hops by which its first copy came; 0: it sent the message
    std::optional<NodeId> from;  ///< whose frame it was
    Time time;                   ///< of its first copy; of the sending
    bool is_delivered = false;   ///< its application has the message
    std::uint64_t copies = 0;    ///< received, the first one included
    std::vector<Time> on_air;    ///< times at which it sent the message on
};

/// The way of one message.
struct FollowedMessage {
    std::uint64_t uid = 0;
    std::string type;
    NodeId origin;
    std::optional<std::uint32_t> to;  ///< its destination; nothing: everybody
    Time sent;
    std::uint64_t size = 0;  ///< [bytes]
    std::int64_t ttl = 0;
    std::vector<FollowedRobot> robots;  ///< the tree: each before those that have it from it
    std::vector<LostCopy> lost;         ///< in the order of the file
    std::vector<NodeId> without;        ///< robots of the trace that received no copy
    Ns2Counts counts;
};

/// Follows the message of an application with this id: the first that the trace has.
///
/// A robot's place in the tree is that of its first copy, `r RTR` or `r AGT`, and of the sender
/// that the MAC header names.
/// @throws InputError as read_ns2_trace(), and if no message has this id
FollowedMessage follow_ns2(Ns2Source source, std::uint64_t uid,
                           Ns2Strictness = Ns2Strictness::tolerant);

}  // namespace rovernet
