// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/lockstep/lockstep.hpp"
#include "live/paced_run.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Ways by which controllers connect to a lock-step run.
struct ControllerAccess {
    std::vector<std::string> programs = {};     ///< shell commands that start controllers
    std::optional<Address> listen = {};         ///< address for connections by TCP
    std::optional<Address> web = {};            ///< address for WebSockets
    std::optional<std::string> unix_path = {};  ///< path of a Unix socket
};

/// Server of the lock-step protocol.
/// @param settings  settings of the protocol; the member `programs` is overwritten
FrontListeners lockstep_listeners(const ControllerAccess& access, Lockstep::Settings settings);

}  // namespace rovernet
