// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

namespace rovernet {

/// laser, sonar or ranger: the robot's range finder, whatever its kind. Nothing is measured unless
/// somebody is told.
class PlayerRangeDevice : public PlayerDevice {
  public:
    /// @param robot  which has a range finder
    explicit PlayerRangeDevice(PlayerRobot& robot);

    PlayerInterface interface() const override;
    Duration period() const override { return finder_.every; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) override;

  private:
    std::optional<std::string> answer_laser(std::uint32_t subtype) const;
    std::optional<std::string> answer_ranger(std::uint32_t subtype) const;
    std::string sonar_poses() const;

    PlayerRobot& robot_;
    RangeFinder finder_;
};

}  // namespace rovernet
