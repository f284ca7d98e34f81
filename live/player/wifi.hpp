// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// wifi: the robots that this one's radio hears, as the link table of a wireless device.
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
