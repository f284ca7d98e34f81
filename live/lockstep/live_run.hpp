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

/// How a scenario is run live: where its controllers come from, and how long they are waited for.
struct LiveOptions {
    std::string folder;                         ///< for the results
    std::vector<std::string> controllers;       ///< programs to start, by the shell
    std::optional<Address> listen = {};         ///< for lines by TCP
    std::optional<Address> web = {};            ///< for WebSockets
    std::optional<std::string> unix_path = {};  ///< path of a Unix socket
    Lockstep::Settings lockstep = {};
    std::optional<std::chrono::nanoseconds> patience = {};  ///< for a question, of real time
    StopRules stop = {};
    /// Told what a person should know: addresses, who is waited for.
    std::function<void(std::string_view)> say = [](std::string_view) {};
};

/// Runs a scenario whose robots are driven by programs outside, in lock-step. It ends when they
/// have left, and writes what run_scenario() writes, and the log of inputs.
/// @throws InputError, RunError, Interrupted; std::invalid_argument for an overlong Unix path
LiveResult run_live(Scenario scenario, const LiveOptions& options);

}  // namespace rovernet
