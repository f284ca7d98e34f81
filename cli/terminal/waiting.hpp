// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace rovernet::cli {

/// Progress display of one step of a command, on a terminal, for steps longer than 1 s. If tell()
/// is called, the display shows the finished share and the remaining time. With --verbose the
/// duration of the step is printed at its end. Only one display may exist at a time.
class Waiting {
  public:
    /// @param what  description of the step, such as "reading office.toml"
    explicit Waiting(std::string what);
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

    /// Reports the finished share of the step, 0 ... 1. The function may be called often. A share
    /// below the previous share starts a new part of the step, with a separate time estimate.
    void tell(double share);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    bool on_terminal_;
    Clock::time_point started_ = Clock::now();
    Clock::time_point next_;  // time of the next update of the line
    std::optional<Clock::time_point>
        told_  // time of the first report of the current part, from which the estimate starts
        = std::nullopt;
    double told_share_ = 0;
};

/// Text of a progress bar: "[====      ]  42 %, 26 s left". If the finished share (0 ... 1) is 0,
/// the remaining time is omitted.
std::string share_text(double share, double elapsed_s);

/// Text of a duration [s]: "26 s", "4 min", "3.2 h".
std::string duration_text(double seconds);

}  // namespace rovernet::cli
