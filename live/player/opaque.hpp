// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// First `opaque` device of a robot: a relay of bytes between the robot's clients, including the
/// sender.
class PlayerRelay : public PlayerDevice {
  public:
    PlayerInterface interface() const override { return PlayerInterface::opaque; }
    bool has_events() const override { return true; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t, XdrReader) override { return std::nullopt; }
    void command(std::uint32_t subtype, XdrReader payload) override;
    void unsubscribed() override { data(); }

  private:
    // Largest number of messages that the relay stores between two calls of data().
    static constexpr std::size_t most = 1'024;
    static constexpr std::size_t most_bytes = std::size_t{3}
                                              << 20U;  // largest size of stored messages [bytes]

    std::vector<std::string> said_;
    std::size_t bytes_ = 0;  // bytes of all stored messages
};

/// Second `opaque` device of a robot: messages by radio. The payload of a command is sent to all
/// robots by the scenario's routing protocol; clients get received messages as data.
///
/// With `has_ttl` the device acts like the comdriver of the 2007 thesis that added radio to Stage:
/// the first byte of a message is its TTL, which each hop decreases by one. A client gets the TTL
/// after the last hop.
class PlayerRadio : public PlayerDevice {
  public:
    PlayerRadio(PlayerRobot& robot, bool has_ttl) : robot_(robot), has_ttl_(has_ttl) {}

    PlayerInterface interface() const override { return PlayerInterface::opaque; }
    bool has_events() const override { return true; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t, XdrReader) override { return std::nullopt; }
    void command(std::uint32_t subtype, XdrReader payload) override;
    void subscribed() override { robot_.listen(true); }
    void unsubscribed() override { robot_.listen(false); }

  private:
    PlayerRobot& robot_;
    bool has_ttl_;
};

}  // namespace rovernet
