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

/// Reads the value of a command-line option as a time > 0, such as "30 s" or 30s.
/// @throws InputError at the option
std::chrono::nanoseconds time_of(const std::string& option, const std::string& text);

/// Folder for the results of a run: `out` if it is given, or else the default folder of `rovernet
/// run`.
std::string results_folder(const std::optional<std::string>& out, const Scenario& scenario,
                           const ScenarioOptions& options);

/// Options that determine which machines can reach the servers of a run: --listen, --insecure.
struct Reach {
    std::optional<std::string> listen;
    bool insecure = false;

    /// Adds the options --listen and --insecure to a command.
    void add_to(Command command);
    /// Address of a server that requires a token if other machines can reach it, read from a text.
    /// @throws CommandEnd if the text is no address
    Address with_token(const std::string& text) const;
    /// Address of a server without access control, read from a text. It is an error if other
    /// machines can reach the address, unless --insecure is given.
    Address without_token(const std::string& text) const;
};

/// Signal handling of a run that serves programs. A signal (Ctrl-C, SIGTERM) ends the run, and the
/// results are written. While the network is set up, a signal ends the process immediately.
class ServingStop {
  public:
    /// Rules for stopping a run on signals; valid as long as this object exists.
    StopRules rules();

  private:
    std::optional<HeldStop> writing_;
};

/// Output channel on which a run announces addresses and tokens.
enum class Announced {
    by_output,  ///< standard output, where programs can read them
    by_notice,  ///< standard error, as for notices; used if the standard output is a JSON document
};
/// Function that prints messages of a run. Announcements (server addresses and tokens, which a
/// waiting program may read) go to the given channel, all other messages to standard error.
std::function<void(std::string_view)> announcer(Announced announced);

}  // namespace rovernet::cli
