// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/front.hpp"
#include "live/player/device.hpp"
#include "live/player/robot.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Where clients find the devices of a robot.
struct PlayerPlace {
    std::string robot;
    std::size_t entrance = 0;  ///< among the addresses of the front
    std::uint32_t index = 0;   ///< of its devices there; of opaque twice that, and one more; of
                               ///< range finders see PlayerDevices
};

/// Device where clients find it.
struct PlacedDevice {
    std::size_t entrance;
    PlayerAddress address;
    std::size_t robot;  ///< number of it among the places
    std::unique_ptr<PlayerDevice> device;
    std::vector<Front::Connection> users = {};  ///< in the order in which they came
};

/// Devices of robots in their places: simulation at the first entrance, and for each robot
/// position2d, wifi, its range finders, and opaque twice: a relay and its radio.
///
/// Where robots of one entrance have at most n lasers, those of a robot with index k are n k,
/// n k + 1, ...; sonars and rangers likewise.
class PlayerDevices {
  public:
    /// @throws std::invalid_argument if there is no robot of a name
    PlayerDevices(Session& session, const std::vector<PlayerPlace>& places);

    /// In their order, which is the same in each run.
    std::list<PlacedDevice>& all() { return devices_; }
    const std::list<PlacedDevice>& all() const { return devices_; }
    /// Null if there is none.
    PlacedDevice* find(std::size_t entrance, PlayerAddress address);

  private:
    void add(std::size_t number, const PlayerPlace& at, PlayerRobot& robot);
    void add_range_finders(std::size_t number, const PlayerPlace& at, PlayerRobot& robot);
    void add(std::size_t robot, std::size_t entrance, std::uint32_t index,
             std::unique_ptr<PlayerDevice> device);

    /// Entrance and interface.
    using Doorway = std::pair<std::size_t, PlayerInterface>;

    std::list<PlayerRobot> robots_;          // devices refer to them
    std::map<Doorway, std::uint32_t> most_;  // range finders of one robot
    std::list<PlacedDevice> devices_;
};

}  // namespace rovernet
