// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/scenario.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

/// What all commands behind their options share. A command prints its result to standard output and
/// throws what goes wrong; FAMILY_commands.hpp has those of a family, with their arguments.
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

/// Ends a command that has done a part of its work, with its code and what to say of it.
class CommandEnd : public std::runtime_error {
  public:
    CommandEnd(ExitCode code, const std::string& message)
        : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// FILE and what may be said over it: a scenario, a Stage world or a movement file.
struct FileArguments {
    std::string file;
    std::optional<std::uint64_t> seed, replication;
    ScenarioOptions options;
};
/// The options over the file, those for the seed and the replication among them.
ScenarioOptions options_of(const FileArguments& arguments);
/// Reads FILE, and says its notices.
Scenario scenario_of(const FileArguments& arguments);

/// The time of an option --at; one after the end of the run is told.
Time time_in(const Scenario& scenario, const std::string& at);

}  // namespace rovernet::cli
