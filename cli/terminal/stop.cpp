// SPDX-License-Identifier: MIT
#include "cli/terminal/stop.hpp"

#include "cli/terminal/commands.hpp"
#include "files/left_behind.hpp"

#include <csignal>
#include <string_view>
#include <unistd.h>

namespace rovernet::cli {
namespace {

volatile std::sig_atomic_t asked = 0, held = 0;

/// Handler of a signal: it does only what is safe in the midst of anything.
void on_signal(int) {
    constexpr int patience = 4;  // signals
    asked = asked + 1;
    if (held > 0 && asked <= patience) return;
    constexpr std::string_view words = "rovernet: interrupted\n";
    (void)!write(STDERR_FILENO, words.data(), words.size());
    clear_away();
    _exit(interrupted);
}

}  // namespace

void end_on_signals() {
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    // Whoever starts it by nohup wants it to go on.
    if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

HeldStop::HeldStop() { held = held + 1; }
HeldStop::~HeldStop() { held = held - 1; }

void write_whole(const std::vector<OutputFile>& files) {
    const HeldStop until_written;
    write_files(files);
}

int stops_asked() { return asked; }

}  // namespace rovernet::cli
