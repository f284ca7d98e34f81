// SPDX-License-Identifier: MIT
#include "cli/display/study_display.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/waiting.hpp"

#include <fmt/format.h>

#include <unistd.h>

namespace rovernet::cli {
namespace {

constexpr int bar_width = 20;  // signs

std::string bar(const SweepProgress& p) {
    const auto over = p.before + p.finished + p.failed;
    const auto full =
        static_cast<int>(over * bar_width / std::max<std::uint64_t>(over + p.left, 1));
    return fmt::format("[{:=<{}}{: <{}}]", "", full, "", bar_width - full);
}

}  // namespace

std::string progress_text(const SweepProgress& p, double elapsed_s) {
    std::string text = fmt::format("{} runs finished, {} failed, {} left", p.before + p.finished,
                                   p.failed, p.left);
    const auto over = static_cast<double>(p.finished + p.failed);
    if (over > 0 && elapsed_s > 0) {
        const double rate = over / elapsed_s;
        text += fmt::format("; {:.3g} runs/s, {} left", rate,
                            duration_text(static_cast<double>(p.left) / rate));
    }
    return text;
}

SweepDisplay::SweepDisplay() : on_terminal_(shows_progress()) {}

SweepDisplay::~SweepDisplay() {
    if (shown_ && on_terminal_) to_terminal("\r\033[K");
}

void SweepDisplay::show(const SweepProgress& progress) {
    using namespace std::chrono_literals;
    const auto now = Clock::now();
    if (now - last_ < (on_terminal_ ? 200ms : 10s)) return;
    last_ = now;
    shown_ = true;
    const std::string text =
        progress_text(progress, std::chrono::duration<double>(now - started_).count());
    if (on_terminal_) {
        to_terminal(fmt::format("\r\033[K{} {}", bar(progress), text));
    } else {
        notice(text);
    }
}

}  // namespace rovernet::cli
