// SPDX-License-Identifier: MIT
#pragma once

#include "study/sweep.hpp"

#include <chrono>
#include <string>

namespace rovernet::cli {

/// Progress display of a sweep on standard error. On a terminal the display is one line that is
/// updated. Otherwise a new line is printed every 10 s.
class SweepDisplay {
  public:
    SweepDisplay();
    ~SweepDisplay();
    SweepDisplay(const SweepDisplay&) = delete;
    SweepDisplay& operator=(const SweepDisplay&) = delete;
    void show(const SweepProgress& progress);

  private:
    using Clock = std::chrono::steady_clock;

    bool on_terminal_;
    bool shown_ = false;
    Clock::time_point started_ = Clock::now();
    Clock::time_point last_ = started_;
};

/// Text of a sweep's progress: "12 runs finished, 1 failed, 87 left; 3.4 runs/s, 26 s left".
/// @param elapsed_s  time since the start of the sweep [s]
std::string progress_text(const SweepProgress& progress, double elapsed_s);

}  // namespace rovernet::cli
