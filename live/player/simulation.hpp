// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/device.hpp"
#include "live/player/robot.hpp"

#include <map>

namespace rovernet {

/// Player device `simulation`: reads and sets poses of robots in the world, by name.
class PlayerSimulation : public PlayerDevice {
  public:
    /// @param robots  robots of the world, by name
    explicit PlayerSimulation(std::map<std::string, PlayerRobot*, std::less<>> robots)
        : robots_(std::move(robots)) {}

    PlayerInterface interface() const override { return PlayerInterface::simulation; }
    std::vector<std::string> data() override { return {}; }
    bool has_events() const override { return true; }
    std::optional<std::string> answer(std::uint32_t subtype, XdrReader payload) override;

  private:
    std::map<std::string, PlayerRobot*, std::less<>> robots_;
};

}  // namespace rovernet
