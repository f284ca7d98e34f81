// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

// Numbers that stand for what a Network owns. They are values: copied, compared and kept in
// records, where a pointer would dangle or tell addresses.

namespace rovernet {

/// Number of a robot, which has one radio: its index in the order in which Network::add() made
/// them, from 0. Robots are never removed, so that an id stays good for the whole run.
///
/// No random draw depends on an id: keys of draws use the robot's name instead, see World::key().
/// So a robot that is added changes no draw of another.
struct NodeId {
    std::uint32_t value = 0;
    /// Index into a table with an entry for each node.
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(NodeId, NodeId) = default;
};

/// Address of all nodes: the destination of a broadcast. No robot has it.
inline constexpr NodeId everyone{0xffffffff};

/// Slot of a message in its MessageTable. It is used again once no frame refers to the message:
/// Message::uid tells messages of a run apart, this does not.
struct MessageId {
    std::uint32_t value = 0;
    /// Index into a table with an entry for each slot, see MessageTable::capacity().
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(MessageId, MessageId) = default;
};

}  // namespace rovernet
