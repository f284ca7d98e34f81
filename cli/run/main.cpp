// SPDX-License-Identifier: MIT
// rovernet_run: the command `run` alone, without a page for the browser. It is built from half of
// the sources, so that tools/rovernet shows the first results in a fresh clone after half of the
// time.
#include "cli/run/run.hpp"
#include "cli/terminal/options.hpp"

int main(int argc, char** argv) {
    using namespace rovernet;
    return cli::run_program(argc, argv, [](cli::Command program) {
        const auto [run, arguments] = cli::add_command(program, "run", "Run a scenario", cli::run);
        cli::add_run_options(run, arguments);
    });
}
