// SPDX-License-Identifier: MIT
#pragma once

#include "cli/command_line.hpp"
#include "live/address.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

/// What the commands share that serve programs outside.
namespace rovernet::cli {

/// A time of an option, such as "30 s" or 30s. @throws InputError
std::chrono::nanoseconds time_of(const std::string& option, const std::string& text);

/// Folder for the results: `out`, or that of `rovernet run`.
std::string results_folder(const std::optional<std::string>& out, const Scenario& scenario,
                           const ScenarioOptions& options);

/// Options that say which machines may reach the servers of a run.
struct Reach {
    std::optional<std::string> listen;
    bool insecure = false;

    /// Adds the options to a command.
    void add_to(Command command);
    /// Address of a server whose clients need a token where other machines reach it.
    /// @throws CommandEnd if it is none
    Address with_token(const std::string& text) const;
    /// Address of a server that serves anybody: of this machine alone, unless --insecure is given.
    Address without_token(const std::string& text) const;
};

/// Whether nobody has asked it to stop.
bool goes_on();

/// Says something to the person at the terminal; addresses and tokens on standard output, where
/// programs read them.
void say_to_all(std::string_view text);

}  // namespace rovernet::cli
