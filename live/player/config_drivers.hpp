// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/config.hpp"
#include "scene/stage/worldfile.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Address of a device in a Player configuration: KEY:HOST:PORT:INTERFACE:INDEX, where leading
/// parts may be missing.
struct ConfiguredDevice {
    std::string interface;
    std::uint32_t port = 6665, index = 0;
    friend bool operator==(const ConfiguredDevice&, const ConfiguredDevice&) = default;
};

/// Device addresses in the list `key` ("provides" or "requires") of a driver in a Player
/// configuration; empty if the driver lacks the key.
/// @throws InputError for an invalid address
std::vector<ConfiguredDevice> configured_devices(const WorldEntity& driver, std::string_view key);

/// Pairs of a robot's IP address and Player port, read from the key `mapping` of a comdriver (radio
/// driver): ["192.168.0.2" 6666 ...]. @throws InputError for any other form
std::vector<PlayerConfig::Mapped> read_mapping(const WorldEntity& driver);

}  // namespace rovernet
