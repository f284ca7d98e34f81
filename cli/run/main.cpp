// SPDX-License-Identifier: MIT
// rovernet_run: the command `run` alone, without a page for the browser. It is built from half of
// the sources, so that tools/rovernet shows the first results in a fresh clone after half of the
// time.
#include "cli/run/run.hpp"
#include "cli/terminal/options.hpp"
#include "cli/terminal/stop.hpp"
#include "experiment/version.hpp"

#include <csignal>
#include <string>

int main(int argc, char** argv) {
    using namespace rovernet;
    cli::end_on_signals();
    std::signal(SIGPIPE, SIG_IGN);
    return cli::run_command_line(
        argc, argv, "rovernet", "rovernet: wireless networks of moving robots, event by event",
        std::string(version()), [](cli::Command program) {
            const auto [run, arguments] =
                cli::add_command(program, "run", "Run a scenario", cli::run);
            cli::add_run_options(run, arguments);
        });
}
