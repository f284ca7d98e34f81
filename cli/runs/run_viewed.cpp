// SPDX-License-Identifier: MIT
#include "cli/run/run.hpp"
#include "cli/runs/run_commands.hpp"
#include "cli/runs/serving.hpp"
#include "cli/runs/view_option.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "experiment/run_folder.hpp"
#include "live/paced_run.hpp"
#include "pictures/viewer/view_run.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rovernet::cli {
namespace {

/// Runs a scenario that a page in a browser shows and paces, and serves the page until Ctrl-C.
void run_viewed(const ViewedRunArguments& a, const Scenario& scenario) {
    PacedOptions options;
    options.folder = a.out ? *a.out : run_folder(scenario, a.options.set);
    options.speed = a.speed.value_or(1);
    options.say = a.view.announced(announcer(a.json ? Announced::by_notice : Announced::by_output));
    options.fronts.push_back(
        a.view.listeners(a.reach, {.of_time = true, .is_for_page = true, .speed = options.speed}));
    bool is_printed = false;
    options.finished = [&](const RunResult& result) {
        print_run(scenario, result, a.json);
        is_printed = true;
        std::fflush(stdout);
        notice("the page shows the run until Ctrl-C");
    };
    ServingStop stop;
    options.stop = stop.rules();
    notice("the run begins when a browser opens the page");
    const LiveResult result = run_paced(scenario, options);
    if (!is_printed) print_run(result.scenario, result.run, a.json);
    if (!result.fault.empty()) throw CommandEnd(failed, result.fault);
}

}  // namespace

void run_or_view(const ViewedRunArguments& a) {
    if (!a.view.is_given()) return run(a);
    const std::optional<Scenario> scenario = scenario_to_run(a);
    if (!scenario) return;
    check_viewable(*scenario, a.file);
    run_viewed(a, *scenario);
}

}  // namespace rovernet::cli
