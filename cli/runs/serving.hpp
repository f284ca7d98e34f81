// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"
#include "cli/terminal/stop.hpp"
#include "live/carriers/address.hpp"
#include "live/logged_run.hpp"
#include "scenario/scenario.hpp"

#include <chrono>
#include <functional>
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

/// Stop of a run that serves programs: a signal ends its run, of which it then writes the results;
/// while a network is set up it ends the process at once.
class ServingStop {
  public:
    /// Valid as long as this object.
    StopRules rules();

  private:
    std::optional<HeldStop> writing_;
};

/// Where a run announces addresses and tokens.
enum class Announced {
    by_output,  ///< on standard output, where programs read them
    by_notice,  ///< like all else that is told: standard output is for one document
};
/// What a run says to the person at the terminal, and to programs that wait for its addresses.
std::function<void(std::string_view)> announcer(Announced announced);

}  // namespace rovernet::cli
