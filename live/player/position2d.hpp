// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// Player device `position2d`: odometry of the robot, and commands to drive it.
class PlayerPosition2d : public PlayerDevice {
  public:
    explicit PlayerPosition2d(PlayerRobot& robot) : robot_(robot) {}

    PlayerInterface interface() const override { return PlayerInterface::position2d; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) override;
    void command(std::uint32_t subtype, XdrReader payload) override;
    void unsubscribed() override { robot_.release(); }

  private:
    PlayerRobot& robot_;
};

}  // namespace rovernet
