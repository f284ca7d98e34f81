// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace rovernet::cli {

/// Progress display of one step of a command, on a terminal, for steps longer than 1 s. It shows
/// the finished share and the time left if tell() is called. With --verbose the duration of the
/// step is printed. Only one display may exist at a time.
class Waiting {
  public:
    /// @param what  description of the step, such as "reading office.toml"
    explicit Waiting(std::string what);
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

    /// Reports the finished share of the step, 0 ... 1; cheap enough to be called often. A share
    /// below the previous one starts a new part, with a separate time estimate.
    void tell(double share);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    bool on_terminal_;
    Clock::time_point started_ = Clock::now();
    Clock::time_point next_;  // time of the next update of the line
    std::optional<Clock::time_point>
        told_  // first report of the part; earlier time is no part of the estimate
        = std::nullopt;
    double told_share_ = 0;
};

/// Progress bar: "[====      ]  42 %, 26 s to go"; without the time while the share is 0.
std::string share_text(double share, double elapsed_s);

}  // namespace rovernet::cli
