// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"

#include <string_view>

namespace rovernet {

/// Where ROS clients look for a server of rosbridge.
inline constexpr std::string_view rosbridge_address = "127.0.0.1:9090";

/// Server of the rosbridge protocol at an address; port 0: any that is free.
FrontDoor rosbridge_door(const Address& at);

}  // namespace rovernet
