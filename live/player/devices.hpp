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
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Address at which clients find the Player devices of one robot.
struct PlayerPlace {
    std::string robot;
    std::size_t listener = 0;  ///< index among the Player server's listening addresses, from 0
    /// Index of the robot's devices at its listening address; for range finders see PlayerDevices.
    std::uint32_t index = 0;
    /// Index of the robot's relay device (`opaque`); none: 2 * `index`.
    std::optional<std::uint32_t> relay = {};
    /// Index of the robot's radio device (`opaque`); none: 2 * `index` + 1.
    std::optional<std::uint32_t> radio = {};
    bool has_ttl = false;  ///< true: the first byte of the robot's radio messages is the TTL
};

/// Player device with the address at which clients find it.
struct PlacedDevice {
    std::size_t listener;
    PlayerAddress address;
    std::size_t robot;  ///< index of the robot in the list of PlayerPlaces
    std::unique_ptr<PlayerDevice> device;
    std::vector<Front::Connection> users = {};  ///< subscribed clients, in order of subscription
};

/// Devices of all robots: `simulation` at the first listening address, and for each robot
/// `position2d`, `wifi`, its range finders, and `opaque` twice (relay and radio).
///
/// Laser j of the robot with index k is `laser:(n k + j)`, where n is the largest number of lasers
/// of a robot at that address. Sonars and rangers are numbered by the same rule.
class PlayerDevices {
  public:
    /// @throws std::invalid_argument if a robot does not exist
    PlayerDevices(Session& session, const std::vector<PlayerPlace>& places);

    /// All Player devices, in an order that is the same in each run.
    std::list<PlacedDevice>& all() { return devices_; }
    const std::list<PlacedDevice>& all() const { return devices_; }
    /// Player device with this address; null if no device has the address.
    PlacedDevice* find(std::size_t listener, PlayerAddress address);

  private:
    void add(std::size_t number, const PlayerPlace& at, PlayerRobot& robot);
    void add_range_finders(std::size_t number, const PlayerPlace& at, PlayerRobot& robot);
    void add(std::size_t robot, std::size_t listener, std::uint32_t index,
             std::unique_ptr<PlayerDevice> device);

    /// Index of the listening address, and Player interface.
    using ListenerInterface = std::pair<std::size_t, PlayerInterface>;

    std::list<PlayerRobot> robots_;  // robots, to which devices refer
    // Largest number of range finders of one robot, by listening address and Player interface.
    std::map<ListenerInterface, std::uint32_t> most_;
    std::list<PlacedDevice> devices_;
};

}  // namespace rovernet
