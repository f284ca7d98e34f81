// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

/// Types and functions shared by all commands. A command prints its result to standard output, and
/// throws errors. The commands of each family (run, scene, result, trace, tool) and their arguments
/// are in FAMILY_commands.hpp.
namespace rovernet::cli {

/// Exit codes of commands.
enum ExitCode {
    ok = 0,
    failed = 1,
    usage = 2,
    bad_input = 3,
    partly_failed = 4,
    interrupted = 130
};

/// Exception that ends a command with an exit code and a message, after a part of its work is done.
class CommandEnd : public std::runtime_error {
  public:
    CommandEnd(ExitCode code, const std::string& message)
        : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// Values of a command's argument FILE (a scenario, a Stage world or a movement file), and of the
/// options that override the content of FILE.
struct FileArguments {
    std::string file;
    std::optional<std::uint64_t> seed, replication;
    ScenarioOptions options;
};
/// Options that override the scenario file, including seed and replication.
ScenarioOptions options_of(const FileArguments& arguments);
/// Reads the scenario of FILE, and prints its notices.
Scenario scenario_of(const FileArguments& arguments);

/// Simulated time of the option --at; prints a notice if the time is after the end of the run.
Time time_in(const Scenario& scenario, const std::string& at);
/// Simulated time of the option --at, for a command that shows effects of traffic, such as routes.
/// @throws InputError if the time is after the end of the run
Time time_within(const Scenario& scenario, const std::string& at);

}  // namespace rovernet::cli
