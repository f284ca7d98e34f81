// SPDX-License-Identifier: MIT
#pragma once

#include "live/carriers/address.hpp"
#include "live/lockstep/lockstep.hpp"
#include "live/logged_run.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Options of a live lock-step run: how controllers connect, and timeouts.
struct LiveOptions {
    std::string folder;                    ///< folder for the results of the run
    std::vector<std::string> controllers;  ///< programs to start, by the shell
    std::optional<Address> listen = {};    ///< address at which controllers connect by TCP
    std::optional<Address> web = {};       ///< address at which controllers connect by WebSocket
    std::optional<std::string> unix_path = {};  ///< path of a Unix socket for controllers
    Lockstep::Settings lockstep = {};
    std::optional<std::chrono::nanoseconds> patience = {};  ///< timeout for a request, in real time
    StopRules stop = {};
    /// Called with notices for the user: addresses, awaited controllers.
    std::function<void(std::string_view)> say = [](std::string_view) {};
};

/// Runs a scenario in lock-step with external programs that drive its robots. The run ends when
/// they have left; it writes the files of run_scenario() and the log of inputs.
/// @throws InputError, RunError, Interrupted; std::invalid_argument for an overlong Unix path
LiveResult run_live(Scenario scenario, const LiveOptions& options);

}  // namespace rovernet
