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

/// Interval between data messages of most Player devices, and between answers to clients in PULL
/// mode; the same as in the simulator Stage.
inline constexpr Duration player_tick = std::chrono::milliseconds(100);

/// Player device of a robot, with one Player interface, to which clients subscribe. The device does
/// not store its clients.
///
/// The functions throw MalformedMessage if the payload is too short or invalid. The server then
/// refuses the request, or ignores the command.
class PlayerDevice {
  public:
    virtual ~PlayerDevice() = default;
    virtual PlayerInterface interface() const = 0;

    /// Interval between data messages of the device.
    virtual Duration period() const { return player_tick; }
    /// Whether every data message must be delivered; otherwise clients get the newest one only.
    virtual bool has_events() const { return false; }
    /// Payloads of data messages (subtype 1) at the current time: one payload, or one for each
    /// event since the last call. Called only while the device has subscribers.
    virtual std::vector<std::string> data() = 0;
    /// Payload of the answer to a request; none: the request is refused.
    virtual std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) = 0;
    virtual void command(std::uint32_t /*subtype*/, XdrReader /*payload*/) {}
    /// Called when the first client subscribes to the device.
    virtual void subscribed() {}
    /// Called when the last client has left the device.
    virtual void unsubscribed() {}
};

}  // namespace rovernet
