// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/message.hpp"
#include "sim/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Time between two data of most devices, and between two answers to clients that pull: Stage's.
inline constexpr Duration player_tick = std::chrono::milliseconds(100);

/// Device that clients subscribe to, as one interface of Player's. It knows no clients.
///
/// A payload that is too short, or makes no sense, is a MalformedMessage: of a request that is
/// refused, of a command that is ignored.
class PlayerDevice {
  public:
    virtual ~PlayerDevice() = default;
    virtual PlayerInterface interface() const = 0;

    /// Time between two of its data.
    virtual Duration period() const { return player_tick; }
    /// Whether each of its data counts. Of others a client is told the newest.
    virtual bool has_events() const { return false; }
    /// Payloads of its data (subtype 1) at the present time: one, or the events since the last
    /// call. Called while somebody is subscribed.
    virtual std::vector<std::string> data() = 0;
    /// Payload of the answer to a request; nothing: it is refused.
    virtual std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) = 0;
    virtual void command(std::uint32_t /*subtype*/, XdrReader /*payload*/) {}
    /// The first client has come, the last one has left.
    virtual void taken() {}
    virtual void let_go() {}
};

}  // namespace rovernet
