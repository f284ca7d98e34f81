// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/command_line.hpp"
#include "cli/terminal/commands.hpp"
#include "cli/terminal/diagnostics.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

/// The commands' options, one file for each family of commands: what a command is called, takes and
/// tells in its --help. What it does stands in FAMILY_commands.hpp.
namespace rovernet::cli {

/// --quiet and --verbose, which every command has.
void add_verbosity(Command command);

/// Adds a command below `parent`. Its arguments live as long as it does; `run` gets them once the
/// command line is read.
/// @return the command and its arguments, for its options
template <class Arguments>
std::pair<Command, Arguments&> add_command(Command parent, const char* name, const char* what,
                                           void (*run)(const Arguments&)) {
    const auto arguments = std::make_shared<Arguments>();
    const Command command = parent.add_command(name, what);
    add_verbosity(command);
    command.runs([arguments, run] { return guarded([&] { run(*arguments); }); });
    return {command, *arguments};
}

/// Arguments of the commands that print what is made from the commands as they are declared.
struct ManualArguments {
    std::optional<Command> program;
    std::string shell;
};
void print_completion(const ManualArguments& arguments);
void print_man_page(const ManualArguments& arguments);

/// Adds FILE and the options that go over it, but for those of one run.
void add_study_file(Command command, FileArguments& arguments, const char* what);
/// Adds FILE and the options that go over it.
void add_file(Command command, FileArguments& arguments, const char* what);
void add_json(Command command, bool& json);
/// Method of intervals of means: t, betting or star.
void add_interval(Command command, std::optional<std::string>& interval);

constexpr const char* any_file =
    "scenario (.toml; - for standard input), Stage world (.world) or movement file";

/// Checks of an option's text, whose errors say what was found and expected.
Check above_zero();
Check not_negative();
Check below_90_degrees();
/// Whole number from 0 to 2^63 - 1, as in a file.
Check whole_number();

/// Adds run, live, emulate, in, sweep, compare, advise, fit, probe, locate.
/// @param typed  the command line as it was typed
void add_run_commands(Command app, const std::string& typed);
/// Adds link, links, scene, where, draw, move.
void add_scene_commands(Command app);
/// Adds results, plot, explain.
void add_result_commands(Command app);
/// Adds trace and what is below it.
void add_trace(Command app);
/// Adds live.
void add_live(Command app);
/// Adds emulate, and in, which runs programs in it.
void add_emulate(Command app);
void add_in(Command app);
/// Adds locate.
void add_locate(Command app);
/// Adds replay.
void add_replay(Command app);
/// Adds models, loss, material, validate, trace, replay, bench, version, completion.
void add_tool_commands(Command app);

}  // namespace rovernet::cli
