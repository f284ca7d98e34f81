// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// position2d: where the robot is by its odometry, and how it is driven.
class PlayerPosition2d : public PlayerDevice {
  public:
    explicit PlayerPosition2d(PlayerRobot& robot) : robot_(robot) {}

    PlayerInterface interface() const override { return PlayerInterface::position2d; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) override;
    void command(std::uint32_t subtype, XdrReader payload) override;
    void let_go() override { robot_.let_go(); }

  private:
    PlayerRobot& robot_;
};

}  // namespace rovernet
