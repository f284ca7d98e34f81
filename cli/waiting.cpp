// SPDX-License-Identifier: MIT
#include "cli/waiting.hpp"

#include "cli/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <unistd.h>

namespace rovernet::cli {
namespace {

constexpr unsigned patience_s = 1;

// What on_alarm() shows: it may come in the midst of anything.
char line[160];
std::size_t line_length = 0;
volatile std::sig_atomic_t shown = 0;

void on_alarm(int) {
    shown = 1;
    (void)!write(STDERR_FILENO, line, line_length);
}

}  // namespace

Waiting::Waiting(std::string what) : what_(std::move(what)) {
    if (!shows_progress()) return;
    const std::string text = what_ + " ... (Ctrl-C ends it)";
    line_length = std::min(text.size(), sizeof line);
    std::copy_n(text.begin(), line_length, line);
    std::signal(SIGALRM, on_alarm);
    alarm(patience_s);
}

Waiting::~Waiting() {
    alarm(0);
    if (shown != 0) to_terminal("\r\033[K");
    shown = 0;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started_;
    detail(fmt::format("{}: {:.3f} s", what_, took.count()));
}

}  // namespace rovernet::cli
