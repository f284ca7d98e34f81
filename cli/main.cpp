// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "cli/diagnostics.hpp"
#include "experiment/run.hpp"
#include "experiment/version.hpp"
#include "sim/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>

namespace {

using namespace rovernet;

/// What a command may end with.
enum Exit { ok = 0, failed = 1, usage = 2, bad_input = 3, interrupted = 130 };

/// Says what went wrong; a mistake in an input begins with its place, anything else with our name.
int fail(Exit code, const std::string& message) {
    cli::error(code == bad_input ? message : "rovernet: " + message);
    return code;
}

/// Runs a command and turns what it throws into a message and an exit code.
int guarded(const std::function<void()>& command) {
    try {
        command();
        return std::fflush(stdout) == 0 ? ok : failed;
    } catch (const InputError& error) {
        return fail(error.where().is_option ? usage : bad_input, error.what());
    } catch (const Interrupted&) {
        return fail(interrupted, "interrupted; no results were written");
    } catch (const std::invalid_argument& error) {
        return fail(usage, error.what());
    } catch (const std::bad_alloc&) {
        return fail(failed, "out of memory");
    } catch (const std::exception& error) {
        return fail(failed, error.what());
    }
}

/// Says so if the first word is no command of ours.
bool is_unknown_command(const CLI::App& app, const std::string& word) {
    if (word.empty() || word.front() == '-') return false;
    std::vector<std::string> names;
    for (const auto* command : app.get_subcommands(nullptr)) {
        if (command->get_name() == word) return false;
        names.push_back(command->get_name());
    }
    const std::string near = did_you_mean(word, names);
    fail(usage, fmt::format("unknown command \"{}\"; expected one of {}{}{}", word,
                            fmt::join(names, ", "), near.empty() ? "" : "; ", near));
    return true;
}

CLI::App* add_command(CLI::App& app, const char* name, const char* what, int& exit,
                      std::function<void()> command) {
    CLI::App* sub = app.add_subcommand(name, what);
    sub->callback([&exit, command = std::move(command)] { exit = guarded(command); });
    return sub;
}

void add_run(CLI::App& app, int& exit) {
    static cli::RunArguments a;
    CLI::App* run = add_command(app, "run", "Run a scenario", exit, [] { cli::run(a); });
    run->add_option("FILE", a.file, "scenario file (.toml)")->required();
    run->add_option("--seed", a.seed, "seed of every random draw");
    run->add_option("--replication", a.replication, "which independent repetition");
    run->add_option("--set", a.set, "key=value over the file's, such as radio.power=\"15 dBm\"")
        ->allow_extra_args(false);
    run->add_option("--out", a.out, "folder for the results (default: runs/NAME-sSEED)");
    run->add_option("--speed", a.speed, "pace the run: 1 is real time, 2 (or x2) twice as fast")
        ->transform(
            [](const std::string& text) { return text.starts_with('x') ? text.substr(1) : text; })
        ->check(CLI::PositiveNumber);
    run->add_flag("--json", a.json, "print one JSON document");
    run->add_flag("--print-scenario", a.print_scenario,
                  "print the scenario with every default, and do not run it");
}

void add_loss(CLI::App& app, int& exit) {
    static cli::LossArguments a;
    CLI::App* loss =
        add_command(app, "loss", "Median path loss of a propagation model over distance", exit,
                    [] { cli::loss(a); });
    loss->add_option("MODEL", a.model, "its name; see rovernet models")->required();
    loss->add_option("PARAMETERS", a.parameters, "param=value ...");
    loss->add_option("--frequency", a.frequency, "such as \"2450 MHz\"")->capture_default_str();
    loss->add_option("--distance", a.distances, "such as 1,10,100 or \"1 km\"")
        ->delimiter(',')
        ->required();
    loss->add_option("--wall", a.wall, "length of wall on the way, such as 0.5");
    loss->add_flag("--json", a.json, "print one JSON document");
}

void add_link(CLI::App& app, int& exit) {
    static cli::LinkArguments a;
    CLI::App* link = add_command(app, "link", "The budget of the link from robot A to robot B",
                                 exit, [] { cli::link(a); });
    link->add_option("FILE", a.file, "scenario file (.toml)")->required();
    link->add_option("A", a.from, "transmitting robot")->required();
    link->add_option("B", a.to, "receiving robot")->required();
    link->add_option("--at", a.at, "time of the run, such as 12.5s")->capture_default_str();
    link->add_option("--seed", a.seed, "seed of every random draw");
    link->add_option("--set", a.set, "key=value over the file's")->allow_extra_args(false);
    link->add_flag("--json", a.json, "print one JSON document");
}

void add_others(CLI::App& app, int& exit) {
    static bool json = false;
    static std::string file;
    add_command(app, "models", "List the propagation models and their parameters", exit, [] {
        cli::models(json);
    })->add_flag("--json", json, "print one JSON document");
    CLI::App* trace = app.add_subcommand("trace", "Work with trace files");
    trace->require_subcommand(1);
    CLI::App* stats =
        add_command(*trace, "stats", "The metrics of an ns-2 trace written by rovernet", exit,
                    [] { cli::trace_stats(file, json); });
    stats->add_option("FILE", file, "trace file (.tr)")->required();
    stats->add_flag("--json", json, "print one JSON document");
    add_command(app, "version", "Print the version and how it was built", exit, [] {
        cli::print_version(json);
    })->add_flag("--json", json, "print one JSON document");
}

}  // namespace

int main(int argc, char** argv) {
    std::signal(SIGINT, [](int) { cli::stop_requested = 1; });
    std::signal(SIGTERM, [](int) { cli::stop_requested = 1; });
    std::signal(SIGPIPE, SIG_IGN);

    CLI::App app{"rovernet: wireless networks of moving robots, event by event", "rovernet"};
    app.set_version_flag("--version", std::string(version()));
    app.require_subcommand(1);
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
        return fmt::format("rovernet: {}; run with --help for more\n", error.what());
    });
    int exit = ok;
    add_run(app, exit);
    add_loss(app, exit);
    add_link(app, exit);
    add_others(app, exit);
    if (argc > 1 && is_unknown_command(app, argv[1])) return usage;
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? ok : usage;
    }
    return exit;
}
