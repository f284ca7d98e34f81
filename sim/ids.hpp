// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

namespace rovernet {

/// A robot's radio node: its index in the order of creation, as the user gave it.
struct NodeId {
    std::uint32_t value = 0;
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(NodeId, NodeId) = default;
};

inline constexpr NodeId everyone{0xffffffff};  ///< the broadcast address

/// A message's slot in its MessageTable; reused once no frame refers to the message.
struct MessageId {
    std::uint32_t value = 0;
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(MessageId, MessageId) = default;
};

}  // namespace rovernet
