// SPDX-License-Identifier: MIT
#pragma once

#include "live/front.hpp"
#include "live/logged_run.hpp"
#include "scenario/scenario.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Front of a run and the addresses where clients find it.
struct FrontDoor {
    struct Address {
        std::string text;  ///< "127.0.0.1:6665", see read_loopback(); port 0: any that is free
        std::string what;  ///< what it is for: "Player, robot A"
    };

    std::vector<Address> addresses;
    std::function<std::unique_ptr<Front>(Front::Carrier)> make;
    bool is_web = false;  ///< clients speak WebSocket: the front gets and sends whole messages
};

/// How a scenario is run by the clock, while clients come and go.
struct PacedOptions {
    std::string folder = {};          ///< for the results
    std::optional<double> speed = 1;  ///< simulated per real time; none: as fast as fronts let it
    std::vector<FrontDoor> fronts = {};
    std::function<bool()> go_on = [] { return true; };  ///< asked now and then; false ends the run
    /// Told what a person should know: addresses that are listened on.
    std::function<void(std::string_view)> say = [](std::string_view) {};
};

/// Runs a scenario by the clock, and lets clients take part in it. It ends with the scenario, when
/// a front is done, or when it is told to; then its results and the log of inputs are written, as
/// by run_live(). The clock decides only at which simulated time an input is accepted. It stands
/// still while a front's limit() holds the run.
/// @throws InputError, RunError; std::invalid_argument for an address
LiveResult run_paced(Scenario scenario, const PacedOptions& options);

}  // namespace rovernet
