// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/paced_run.hpp"

namespace rovernet {

/// Server of the rosbridge protocol at an address; port 0: any free port.
FrontListeners rosbridge_listener(const Address& at);

inline constexpr FrontOption rosbridge_option{
    "--rosbridge", "ROS clients by the rosbridge protocol", "127.0.0.1:9090", rosbridge_listener};

}  // namespace rovernet
