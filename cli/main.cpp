// SPDX-License-Identifier: MIT
#include "cli/terminal/options.hpp"
#include "study/command_words.hpp"

#include <algorithm>
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
    const std::string typed = command_line(argc, argv);
    return cli::run_program(argc, argv, [&](cli::Command program) {
        cli::add_run_commands(program, typed);
        cli::add_scene_commands(program);
        cli::add_result_commands(program);
        cli::add_tool_commands(program);
    });
}
