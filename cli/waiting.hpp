// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

namespace rovernet::cli {

/// What a command is at: shown on a terminal once it has taken a second, until it is done; with
/// --verbose its time is told. One at a time.
class Waiting {
  public:
    /// @param what  "reading office.toml"
    explicit Waiting(std::string what);
    ~Waiting();
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

  private:
    std::string what_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace rovernet::cli
