// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"

#include <string_view>

namespace rovernet {

/// Default address at which ROS clients connect to a rosbridge server.
inline constexpr std::string_view rosbridge_address = "127.0.0.1:9090";

/// Server of the rosbridge protocol at an address; port 0: any free port.
FrontListeners rosbridge_listener(const Address& at);

}  // namespace rovernet
