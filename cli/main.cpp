// SPDX-License-Identifier: MIT
#include "cli/terminal/options.hpp"
#include "cli/terminal/stop.hpp"
#include "experiment/version.hpp"
#include "study/command_words.hpp"

#include <algorithm>
#include <csignal>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace rovernet;

/// Command line as typed, for a hint how to continue; options that confirm the loss of data are
/// removed.
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

    const std::string typed = command_line(argc, argv);
    return cli::run_command_line(argc, argv, "rovernet",
                                 "rovernet: wireless networks of moving robots, event by event",
                                 std::string(version()), [&](cli::Command program) {
                                     cli::add_run_commands(program, typed);
                                     cli::add_scene_commands(program);
                                     cli::add_result_commands(program);
                                     cli::add_tool_commands(program);
                                 });
}
