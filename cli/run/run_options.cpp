// SPDX-License-Identifier: MIT
#include "cli/run/run.hpp"
#include "cli/terminal/options.hpp"

namespace rovernet::cli {

void add_run_options(Command run, RunArguments& a) {
    run.add_examples(
        {"rovernet run examples/patrol/patrol.toml",
         "rovernet run examples/rescue/rescue.toml --seed 7 --out rescue-7",
         "rovernet run examples/rescue/rescue.toml --record",
         "rovernet run examples/rescue/rescue.toml --set propagation.model=friis --json"});
    add_file(run, a, any_file);
    run.add_option(
        "--out", a.out,
        "folder for the results (default: runs/NAME-sSEED; with --set: runs/NAME-sSEED-KEY=VALUE)");
    run.add_option("--speed", a.speed,
                   "speed relative to real time: 1 is real time, 2 (or x2) is twice as fast "
                   "(default: as fast as possible)")
        .transform(
            [](const std::string& text) { return text.starts_with('x') ? text.substr(1) : text; })
        .check(speed_of_time());
    run.add_flag(
        "--record", a.record,
        "also write trace.mcap, a record of the whole run that rovernet replay and rovernet view "
        "read");
    add_json(run, a.json);
    run.add_flag("--print-scenario", a.print_scenario,
                 "print the scenario with all defaults, without running it");
}

}  // namespace rovernet::cli
