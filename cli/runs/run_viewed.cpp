// SPDX-License-Identifier: MIT
#include "cli/runs/run_commands.hpp"
#include "cli/runs/run_output.hpp"
#include "cli/runs/serving.hpp"
#include "cli/runs/view_option.hpp"
#include "cli/terminal/diagnostics.hpp"
#include "experiment/run_folder.hpp"
#include "live/paced_run.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rovernet::cli {

void run_viewed(const RunArguments& a, const Scenario& scenario) {
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

}  // namespace rovernet::cli
