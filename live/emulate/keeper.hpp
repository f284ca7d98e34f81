// SPDX-License-Identifier: MIT
#pragma once

#include "live/emulate/tap.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// Message of the keeper (process that owns the robots' networks) to all admitted clients: the run
/// has ended.
inline constexpr const char* run_has_ended = "ended";

/// Keeper: the process that holds the robots' network namespaces and passes them to clients of
/// their listeners (RobotListener). The keeper sends the descriptor of each robot's device to the
/// run's process, then serves clients until the run's process ends for any reason.
///
/// The keeper admits root and the user of the run. A client gets the namespace and the run's
/// folder, and keeps the connection, which reports the end of the run. At the end of the run, the
/// keeper kills all programs in the namespaces.
///
/// @param socket  socket to the run's process
/// @param folder  folder of the run's results
[[noreturn]] void run_keeper(int socket, const std::vector<RobotDevice>& robots,
                             const std::string& folder);

}  // namespace rovernet
