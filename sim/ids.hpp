// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

// Ids of objects that a Network owns. Ids are values that can be copied, compared and stored in
// records; a pointer could dangle, and its address differs from run to run.

namespace rovernet {

/// Id of a robot, which has one radio: its index in the order of Network::add(), from 0. Robots are
/// never removed, so an id is valid for the whole run.
///
/// No random draw depends on an id: keys of draws use the robot's name instead, see World::key().
/// Therefore adding a robot does not change the draws of the other robots.
struct NodeId {
    std::uint32_t value = 0;
    /// Index into a table with an entry for each node.
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(NodeId, NodeId) = default;
};

/// Address of all nodes: the destination of a broadcast. No robot has this id.
inline constexpr NodeId everyone{0xffffffff};

/// Slot of a message in its MessageTable. The slot is reused once no frame refers to the message;
/// Message::uid is unique in a run, a MessageId is not.
struct MessageId {
    std::uint32_t value = 0;
    /// Index into a table with an entry for each slot, see MessageTable::capacity().
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(MessageId, MessageId) = default;
};

}  // namespace rovernet
