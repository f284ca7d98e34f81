// SPDX-License-Identifier: MIT
#pragma once

#include "sim/error.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rovernet {

/// Configuration file of a Player server (.cfg), as far as it says which robots of which world are
/// found where:
///
///   driver ( name "stage" provides [ "simulation:0" ] worldfile "simple.world" )
///   driver ( name "stage" provides [ "6665:position2d:0" "6665:wifi:0" ] model "robot1" )
///
/// Everything else in it is passed over: what runs beside Stage in a Player server does not run
/// here, but clients may do it.
struct PlayerConfig {
    /// Robot and where its position2d is.
    struct Robot {
        std::string model;
        std::uint16_t port = 6665;
        std::uint32_t index = 0;
        Location where = {};
    };

    std::string world;  ///< path, relative to the working directory or from the root
    std::vector<Robot> robots;
};

/// Reads such a file. @throws InputError with file, line and column
PlayerConfig read_player_config(const std::string& path);

}  // namespace rovernet
