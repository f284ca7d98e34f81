// SPDX-License-Identifier: MIT
#include "cli/diagnostics.hpp"
#include "cli/options.hpp"
#include "cli/run_output.hpp"
#include "cli/stop.hpp"
#include "experiment/run_folder.hpp"
#include "live/input_log.hpp"
#include "live/live_run.hpp"
#include "scenario/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace rovernet::cli {
namespace {

struct LiveArguments : FileArguments {
    std::optional<std::string> out, listen, unix_path, patience;
    std::vector<std::string> controllers;
    std::optional<std::uint64_t> wait_for;
    std::string on_loss = "end";
    bool json = false;
};

/// A time of an option, such as "30 s" or 30s.
std::chrono::nanoseconds time_of(const std::string& option, const std::string& text) {
    const Location where{.source = option + " " + text, .is_option = true};
    const double s = read_quantity(placed(Value(text), where), "time", Dimension::time);
    if (!(s > 0)) throw InputError(where, "expected a time above 0 s");
    return from_seconds(s);
}

LiveOptions options_of(const LiveArguments& a, const Scenario& scenario) {
    LiveOptions options{.folder = a.out ? *a.out : run_folder(scenario, a.options.set),
                        .controllers = a.controllers,
                        .listen = a.listen,
                        .unix_path = a.unix_path};
    const std::size_t started = std::max<std::size_t>(a.controllers.size(), 1);
    options.lockstep.wait_for = a.wait_for ? static_cast<std::size_t>(*a.wait_for) : started;
    options.lockstep.on_loss = a.on_loss == "stop"   ? OnLoss::stop
                               : a.on_loss == "wait" ? OnLoss::wait
                                                     : OnLoss::end;
    if (a.patience) options.patience = time_of("--patience", *a.patience);
    options.go_on = [] { return stops_asked() == 0; };
    options.say = [](std::string_view text) {
        // Programs read the address from standard output, before there is any result.
        if (!text.starts_with("listening")) return notice(text);
        fmt::print("{}\n", text);
        std::fflush(stdout);
    };
    return options;
}

void run_live(const LiveArguments& a) {
    if (a.controllers.empty() && !a.listen && !a.unix_path) {
        throw CommandEnd(usage, "live: expected --controller, --listen-json or --unix");
    }
    const Scenario scenario = scenario_of(a);
    const HeldStop serving;
    const LiveResult result = rovernet::run_live(scenario, options_of(a, scenario));
    print_run(result.scenario, result.run, a.json);
    if (!result.fault.empty()) throw CommandEnd(failed, result.fault);
}

}  // namespace

void add_live(Command app) {
    const auto [live, a] = add_command(
        app, "live", "Run a scenario whose robots are driven by programs outside", run_live);
    live.add_examples(
        {"rovernet live examples/search/search.toml --controller \"python3 "
         "examples/search/search.py\""});
    add_file(live, a, any_file);
    live.add_option(
            "--controller", a.controllers,
            "program to start, which speaks by its standard input and output; several times")
        .one_word();
    live.add_option("--listen-json", a.listen,
                    "127.0.0.1:PORT to listen on for controllers; port 0: any that is free");
    live.add_option("--unix", a.unix_path, "path of a Unix socket to listen on for controllers");
    live.add_option("--wait-for", a.wait_for,
                    "controllers with which the run begins (default: those started, or 1)")
        .range(1, 500);
    live.add_option("--patience", a.patience,
                    "real time that a controller may take for a step, such as 30s (default: any)");
    live.add_option(
            "--on-loss", a.on_loss,
            "when a controller has gone without a bye: end; stop its robots; or wait for it")
        .one_of({"end", "stop", "wait"})
        .shows_default();
    live.add_option("--out", a.out, "folder for the results (default: as that of run)");
    add_json(live, a.json);
}

}  // namespace rovernet::cli
