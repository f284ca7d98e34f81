// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"
#include "cli/terminal/commands.hpp"
#include "cli/terminal/diagnostics.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

/// Declarations of commands: name, options and --help text. Each family of commands (run, scene,
/// result, trace, tool) is declared in FAMILY_options.cpp. The functions that execute commands are
/// in FAMILY_commands.hpp.
namespace rovernet::cli {

/// Runs the program `rovernet` with the commands that `declare` adds: handles signals, parses the
/// command line and runs its command. @return exit code
int run_program(int argc, char** argv, const std::function<void(Command program)>& declare);

/// Adds --quiet and --verbose, which every command has.
void add_verbosity(Command command);

/// Adds a subcommand to `parent`. `run` executes the subcommand with its arguments after parsing.
/// The arguments exist as long as the subcommand.
/// @return the subcommand and its arguments, for adding options
template <class Arguments>
std::pair<Command, Arguments&> add_command(Command parent, const char* name, const char* what,
                                           void (*run)(const Arguments&)) {
    const auto arguments = std::make_shared<Arguments>();
    const Command command = parent.add_command(name, what);
    add_verbosity(command);
    command.runs([arguments, run] { return guarded([&] { run(*arguments); }); });
    return {command, *arguments};
}

/// Arguments of the commands that print completion scripts and the man page.
struct ManualArguments {
    std::optional<Command> program;
    std::string shell;
};
void print_completion(const ManualArguments& arguments);
void print_man_page(const ManualArguments& arguments);

/// Adds the argument FILE, and the options that override its content except --replication, which is
/// for commands of a single run.
void add_study_file(Command command, FileArguments& arguments, const char* what);
/// Adds the argument FILE, and all options that override its content, including --replication.
void add_file(Command command, FileArguments& arguments, const char* what);
void add_json(Command command, bool& json);
/// Adds the option --interval, the method of confidence intervals of means: t, betting or star.
void add_interval(Command command, std::optional<std::string>& interval);

constexpr const char* any_file =
    "scenario (.toml; - for standard input), Stage world (.world) or movement file";

/// Check that an option's value is a number in a range. The error message names the found and the
/// expected value.
Check above_zero();
/// Check of the ratio of simulated time to real time [-].
Check speed_of_time();
Check not_negative();
Check below_90_degrees();
/// Check that an option's value is a whole number from 0 to 2^63 - 1, as in a scenario file.
Check whole_number();

/// Adds the commands run, live, emulate, in, sweep, compare, advise, fit, probe, locate.
/// @param typed  command line as the user typed it
void add_run_commands(Command app, const std::string& typed);
/// Adds the commands link, links, routes, scene, where, draw, move.
void add_scene_commands(Command app);
/// Adds the commands results, plot, explain.
void add_result_commands(Command app);
/// Adds the command trace and its subcommands.
void add_trace(Command app);
/// Adds the command live.
void add_live(Command app);
/// Adds the commands `emulate` and `in`. The command `in` runs programs in an emulated network.
void add_emulate(Command app);
void add_in(Command app);
/// Adds the command locate.
void add_locate(Command app);
/// Adds the command replay.
void add_replay(Command app);
/// Adds the command view.
void add_view(Command app);
/// Adds the commands models, loss, material, validate, trace, replay, bench, version, completion.
void add_tool_commands(Command app);

}  // namespace rovernet::cli
