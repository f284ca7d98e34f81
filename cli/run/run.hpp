// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"
#include "cli/terminal/commands.hpp"
#include "experiment/run.hpp"

#include <optional>
#include <string>

/// The command `run`, without the page that can show a run (cli/runs/run_viewed.cpp).
namespace rovernet::cli {

struct RunArguments : FileArguments {
    std::optional<std::string> out;
    std::optional<double> speed;
    bool json = false;
    bool print_scenario = false;
    bool record = false;
};

/// Adds the argument FILE, the options that set `arguments`, and examples.
void add_run_options(Command command, RunArguments& arguments);
/// Reads the scenario of a run, and prints its notices. With --print-scenario the scenario is
/// printed, and the result is empty.
std::optional<Scenario> scenario_to_run(const RunArguments& arguments);
void run(const RunArguments& arguments);
/// Prints the results of a run, as text or as JSON.
void print_run(const Scenario& scenario, const RunResult& result, bool json);

}  // namespace rovernet::cli
