// SPDX-License-Identifier: MIT
#include "cli/terminal/waiting.hpp"

#include "cli/terminal/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <unistd.h>

namespace rovernet::cli {
namespace {

constexpr unsigned patience_s = 1;
constexpr std::chrono::milliseconds between_looks{200};

// State that on_alarm() shows: it may come in the midst of anything.
char line[160];
std::size_t line_length = 0;
volatile std::sig_atomic_t shown = 0;

void on_alarm(int) {
    shown = 1;
    (void)!write(STDERR_FILENO, line, line_length);
}

}  // namespace

Waiting::Waiting(std::string what)
    : what_(std::move(what)),
      on_terminal_(shows_progress()),
      next_(started_ + std::chrono::seconds{patience_s}) {
    if (!on_terminal_) return;
    const std::string text = what_ + " ... (Ctrl-C ends it)";
    line_length = std::min(text.size(), sizeof line);
    std::copy_n(text.begin(), line_length, line);
    std::signal(SIGALRM, on_alarm);
    alarm(patience_s);
}

void Waiting::tell(double share) {
    if (!on_terminal_) return;
    const auto now = Clock::now();
    if (!told_ || share < told_share_) told_ = now;
    told_share_ = share;
    if (now < next_) return;
    next_ = now + between_looks;
    alarm(0);  // the bar says more
    shown = 1;
    const std::chrono::duration<double> elapsed = now - *told_;
    to_terminal("\r\033[K" + share_text(share, elapsed.count()));
}

std::string share_text(double share, double elapsed_s) {
    constexpr int width = 40;
    const int full = static_cast<int>(share * width);
    std::string text =
        fmt::format("[{:=<{}}{: <{}}] {:3.0f} %", "", full, "", width - full, 100 * share);
    if (share > 0) text += ", " + duration_text(elapsed_s * (1 - share) / share) + " left";
    return text;
}

std::string duration_text(double seconds) {
    if (seconds < 9.5) return fmt::format("{:.2g} s", seconds);
    if (seconds < 100) return fmt::format("{:.0f} s", seconds);
    if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

Waiting::~Waiting() {
    alarm(0);
    if (shown != 0) to_terminal("\r\033[K");
    shown = 0;
    const std::chrono::duration<double> took = Clock::now() - started_;
    detail(fmt::format("{}: {:.3f} s", what_, took.count()));
}

}  // namespace rovernet::cli
