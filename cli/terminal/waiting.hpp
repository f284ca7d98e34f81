// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace rovernet::cli {

/// Display of what a command is at: shown on a terminal once it has taken a second, until it is
/// done, with the share that is done and the time left if these are told; with --verbose its time
/// is told. One at a time.
class Waiting {
  public:
    /// @param what  "reading office.toml"
    explicit Waiting(std::string what);
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

    /// Tells the share that is done, 0 ... 1: cheap, to be called often. A share below the last one
    /// is that of a next part, whose time is its own.
    void tell(double share);

  private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    bool on_terminal_;
    Clock::time_point started_ = Clock::now();
    Clock::time_point next_;                // look of the line
    std::optional<Clock::time_point> told_  // first: what came before tells nothing of the rest
        = std::nullopt;
    double told_share_ = 0;
};

/// "[====      ]  42 %, 26 s to go"; without the time while nothing is done.
std::string share_text(double share, double elapsed_s);

}  // namespace rovernet::cli
