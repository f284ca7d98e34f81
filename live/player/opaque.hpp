// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// opaque, the first: a relay of bytes among the clients of one robot, the sender included.
class PlayerRelay : public PlayerDevice {
  public:
    PlayerInterface interface() const override { return PlayerInterface::opaque; }
    bool has_events() const override { return true; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t, XdrReader) override { return std::nullopt; }
    void command(std::uint32_t subtype, XdrReader payload) override;
    void let_go() override { data(); }

  private:
    static constexpr std::size_t most = 1'024;                        // messages between two data
    static constexpr std::size_t most_bytes = std::size_t{3} << 20U;  // of them

    std::vector<std::string> said_;
    std::size_t bytes_ = 0;  // of all that was said
};

/// opaque, the second: bytes by radio. The robot sends them to everyone by the scenario's routing
/// protocol; what it hears is data.
class PlayerRadio : public PlayerDevice {
  public:
    explicit PlayerRadio(PlayerRobot& robot) : robot_(robot) {}

    PlayerInterface interface() const override { return PlayerInterface::opaque; }
    bool has_events() const override { return true; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t, XdrReader) override { return std::nullopt; }
    void command(std::uint32_t subtype, XdrReader payload) override;
    void taken() override { robot_.listen(true); }
    void let_go() override { robot_.listen(false); }

  private:
    PlayerRobot& robot_;
};

}  // namespace rovernet
