// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/tap.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// What a keeper sends to all whom it has let in: the run has ended.
inline constexpr const char* run_has_ended = "ended";

/// Process that keeps the robots' network namespaces and hands them out at their doors (RobotDoor).
/// It sends the descriptor of each robot's device to the process for which it works, then serves
/// until that has gone, however that ends.
///
/// It lets in root, and the user whose it is. Who is let in gets the namespace and the run's
/// folder, and keeps the connection, by which he learns that the run has ended. Then the keeper
/// ends all programs that it finds in the namespaces, whoever has started them.
///
/// @param socket  to the process for which it works
/// @param folder  of the run's results
[[noreturn]] void run_keeper(int socket, const std::vector<RobotDevice>& robots,
                             const std::string& folder);

}  // namespace rovernet
