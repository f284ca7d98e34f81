// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Interface that a range finder has, by its kind.
PlayerInterface player_interface(const Scanner& scanner);

/// laser, sonar or ranger: a range finder of the robot, whatever its kind. Nothing is measured
/// unless somebody is told.
class PlayerRangeDevice : public PlayerDevice {
  public:
    /// @param number  of the range finder among those of the robot
    PlayerRangeDevice(PlayerRobot& robot, std::size_t number);

    PlayerInterface interface() const override;
    Duration period() const override { return scanner_.finder.every; }
    std::vector<std::string> data() override;
    std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) override;

  private:
    std::optional<std::string> answer_laser(std::uint32_t subtype) const;
    std::optional<std::string> answer_ranger(std::uint32_t subtype) const;
    std::string sonar_poses() const;
    std::string ranger_poses() const;

    PlayerRobot& robot_;
    std::size_t number_;
    const Scanner& scanner_;  // of the session
    Radians first_, last_;    // beams, from the heading of the scanner
};

}  // namespace rovernet
