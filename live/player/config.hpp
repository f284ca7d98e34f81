// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Content of a Player server's configuration file (.cfg) that assigns robots of a world to ports:
///
///   driver ( name "stage" provides [ "simulation:0" ] worldfile "simple.world" )
///   driver ( name "stage" provides [ "6665:position2d:0" "6665:wifi:0" ] model "robot1" )
///   driver ( name "relay" provides [ "6665:opaque:0" ] )
///   driver ( name "comdriver" provides [ "6665:opaque:1" ] requires [ "6665:wifi:0" ]
///            mapping [ "192.168.0.2" 6666 ] )
///
/// The comdriver is the driver of the 2007 thesis that added radio to Stage
/// (docs/formats/worlds.md): it sends messages by radio, and the first byte of a message is the
/// time-to-live. Its mapping gives the Player port of the robot with each IP address. Other drivers
/// of a Player server are not supported; a notice names them.
struct PlayerConfig {
    /// Entry of the key `mapping` of a comdriver (radio driver): a robot's IP address and its
    /// Player port.
    struct Mapped {
        std::string ip;
        std::uint16_t port = 6665;
    };
    /// Driver `comdriver` of a robot: radio messages through an `opaque` device.
    struct Comdriver {
        std::uint32_t index = 1;  ///< index of the `opaque` device of the comdriver
        std::vector<Mapped> mapping = {};
        Location where = {};
    };
    /// Robot of a configuration file, with the address of its position2d device.
    struct Robot {
        std::string model;
        std::uint16_t port = 6665;
        std::uint32_t index = 0;
        Location where = {};
        std::optional<Comdriver> comdriver = {};
        std::optional<std::uint32_t> relay = {};  ///< index of the robot's relay (`opaque` device)
    };

    std::string world;  ///< path of the world file, absolute or relative to the working directory
    std::vector<Robot> robots;
    std::vector<std::string> notices = {};  ///< notices to the user, "file:line: text"

    /// Whether a robot has a comdriver (radio driver), so that radio messages begin with a
    /// time-to-live byte.
    bool has_comdriver() const;
};

/// Reads a Player configuration file. @throws InputError with file, line and column
PlayerConfig read_player_config(const std::string& path);

/// Notices about mappings of comdrivers (radio drivers) from IP addresses to Player ports that
/// contradict the robots of the file and their addresses.
/// @param ips  IP address of each robot, in the order of the file; "" if it has none
std::vector<std::string> mapping_notices(const PlayerConfig& config,
                                         const std::vector<std::string>& ips);

}  // namespace rovernet
