// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"
#include "scene/scanner.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Player interface of a range finder, by its kind.
PlayerInterface player_interface(const Scanner& scanner);

/// Player device `laser`, `sonar` or `ranger`: a range finder of the robot. A scan is computed only
/// if there are subscribers.
class PlayerRangeDevice : public PlayerDevice {
  public:
    /// @param number  index of the range finder on the robot, from 0
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
    const Scanner& scanner_;  // owned by the session
    Radians first_,
        last_;  // directions of the first and last beam, relative to the heading of the scanner
};

}  // namespace rovernet
