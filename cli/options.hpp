// SPDX-License-Identifier: MIT
#pragma once

#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "cli/manual.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>
#include <utility>

/// The commands' options, one file for each family of commands: what a command is called, takes and
/// tells in its --help. What it does stands in commands.hpp.
namespace rovernet::cli {

/// --quiet and --verbose, which every command has.
void add_verbosity(CLI::App& command);

/// Adds a command below `parent`. Its arguments live as long as it does; `run` gets them once the
/// command line is read. CLI::RuntimeError then carries an exit code other than 0.
/// @return the command and its arguments, for its options
template <class Arguments>
std::pair<CLI::App&, Arguments&> add_command(CLI::App& parent, const char* name, const char* what,
                                             void (*run)(const Arguments&)) {
    const auto arguments = std::make_shared<Arguments>();
    CLI::App* command = parent.add_subcommand(name, what);
    add_verbosity(*command);
    command->callback([arguments, run] {
        const int code = guarded([&] { run(*arguments); });
        if (code != ok) throw CLI::RuntimeError(code);
    });
    return {*command, *arguments};
}

/// Arguments of the commands that print what is made from the commands as they are declared.
struct ManualArguments {
    const CLI::App* app = nullptr;
    std::string shell;
};
void print_completion(const ManualArguments& arguments);
void print_man_page(const ManualArguments& arguments);

/// Adds FILE and the options that go over it, but for those of one run.
void add_study_file(CLI::App& command, FileArguments& arguments, const char* what);
/// Adds FILE and the options that go over it.
void add_file(CLI::App& command, FileArguments& arguments, const char* what);
void add_json(CLI::App& command, bool& json);
/// Method of intervals of means: t or betting.
void add_interval(CLI::App& command, std::optional<std::string>& interval);

constexpr const char* any_file =
    "scenario (.toml; - for standard input), Stage world (.world) or movement file";

/// Checks of an option's text, whose errors say what was found and expected.
CLI::Validator above_zero();
CLI::Validator not_negative();
CLI::Validator below_90_degrees();
/// Whole number from 0 to 2^63 - 1, as in a file.
CLI::Validator whole_number();

/// Adds run, sweep, compare, advise, fit, probe, validate. @param typed  the command line as it was
/// typed
void add_run_commands(CLI::App& app, const std::string& typed);
/// Adds link, links, scene, where, draw, move.
void add_scene_commands(CLI::App& app);
/// Adds results, plot, explain.
void add_result_commands(CLI::App& app);
/// Adds models, loss, material, validate, trace, bench, version, completion.
void add_tool_commands(CLI::App& app);

}  // namespace rovernet::cli
