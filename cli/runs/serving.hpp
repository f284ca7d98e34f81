// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"
#include "cli/terminal/stop.hpp"
#include "live/carriers/address.hpp"
#include "live/logged_run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// Functions shared by the commands that serve external programs (live, emulate).
namespace rovernet::cli {

/// Reads a time of an option, such as "30 s" or 30s. @throws InputError
std::chrono::nanoseconds time_of(const std::string& option, const std::string& text);

/// Folder for the results: `out`, or the default folder of `rovernet run`.
std::string results_folder(const std::optional<std::string>& out, const Scenario& scenario,
                           const ScenarioOptions& options);

/// Options that decide which machines can reach the servers of a run.
struct Reach {
    std::optional<std::string> listen;
    bool insecure = false;

    /// Adds the options of this struct to a command.
    void add_to(Command command);
    /// Address of a server whose clients need a token if other machines can reach it.
    /// @throws CommandEnd if the text is no address
    Address with_token(const std::string& text) const;
    /// Address of a server without access control: a loopback address, unless --insecure is given.
    Address without_token(const std::string& text) const;
};

/// Signal handling of a run that serves programs: a signal ends the run, and its results are
/// written. While the network is set up, a signal ends the process at once.
class ServingStop {
  public:
    /// Rules for stopping a run on signals; valid as long as this object.
    StopRules rules();

  private:
    std::optional<HeldStop> writing_;
};

/// Output channel on which a run announces addresses and tokens.
enum class Announced {
    by_output,  ///< standard output, where programs can read them
    by_notice,  ///< standard error, like all notices, since standard output contains one document
};
/// Function that prints announcements of a run, for the user and for programs that wait for its
/// addresses.
std::function<void(std::string_view)> announcer(Announced announced);

}  // namespace rovernet::cli
