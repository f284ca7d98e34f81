// SPDX-License-Identifier: MIT
#include "cli/diagnostics.hpp"
#include "cli/options.hpp"
#include "cli/stop.hpp"
#include "experiment/version.hpp"
#include "sim/error.hpp"
#include "study/command_words.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace rovernet;
using cli::ok, cli::usage;

/// The command that the words of the command line name, as far as they do.
const CLI::App& named_command(const CLI::App& app) {
    const auto named = app.get_subcommands();
    return named.empty() ? app : named_command(*named.front());
}

std::vector<std::string> options_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
        for (const auto& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

std::vector<std::string> commands_of(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::App* sub : command.get_subcommands(nullptr)) {
        if (!sub->get_group().empty()) names.push_back(sub->get_name());
    }
    return names;
}

/// Message of what is wrong with the words of the command line, and what was probably meant.
std::string usage_error(const CLI::App* app, const CLI::Error& error) {
    std::string what = error.what();
    const std::vector<std::string> unexpected = app->remaining(true);
    if (!unexpected.empty()) {
        const std::string word = unexpected.front().substr(0, unexpected.front().find('='));
        const CLI::App& command = named_command(*app);
        const std::vector<std::string> commands = commands_of(command);
        const bool is_option = word.starts_with('-');
        if (is_option) {
            what = fmt::format("unknown option \"{}\"", word);
        } else if (!commands.empty()) {
            what = fmt::format("unknown command \"{}\"; expected one of {}", word,
                               fmt::join(commands, ", "));
        } else {
            what = fmt::format("unexpected \"{}\"", word);
        }
        const std::string near = did_you_mean(word, is_option ? options_of(command) : commands);
        if (!near.empty()) what += "; " + near;
    }
    return fmt::format("rovernet: {}; run with --help for more\n", what);
}

/// The command as it was typed, for a person to go on with: what it threw away stays so.
std::string command_line(int argc, char** argv) {
    std::vector<std::string> words{"rovernet"};
    std::copy_if(argv + 1, argv + argc, std::back_inserter(words),
                 [](std::string_view word) { return word != "--fresh" && word != "--yes"; });
    return shell_command(words);
}

}  // namespace

int main(int argc, char** argv) {
    cli::end_on_signals();
    std::signal(SIGPIPE, SIG_IGN);

    CLI::App app{"rovernet: wireless networks of moving robots, event by event", "rovernet"};
    app.set_version_flag("--version", std::string(version()));
    app.require_subcommand(1);
    app.failure_message(usage_error);
    cli::add_run_commands(app, command_line(argc, argv));
    cli::add_scene_commands(app);
    cli::add_result_commands(app);
    cli::add_tool_commands(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::RuntimeError& end) {
        return end.get_exit_code();
    } catch (const CLI::ParseError& error) {
        std::ostringstream text;  // std::cout would lose why it cannot be written
        if (app.exit(error, text) != 0) return usage;
        return cli::guarded([&] { fmt::print("{}", text.str()); });
    }
    return ok;
}
