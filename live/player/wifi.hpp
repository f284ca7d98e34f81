// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// Player device `wifi`: link table of the robot, with the robots in range of its radio.
class PlayerWifi : public PlayerDevice {
  public:
    explicit PlayerWifi(PlayerRobot& robot) : robot_(robot) {}

    PlayerInterface interface() const override { return PlayerInterface::wifi; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) override;

  private:
    PlayerRobot& robot_;
};

}  // namespace rovernet
