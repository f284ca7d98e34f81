// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/waiting.hpp"
#include "experiment/playing.hpp"

#include <fmt/format.h>

#include <string>

namespace rovernet::cli {

/// Progress display while a command simulates a scenario until a given time, see Waiting.
class Playing {
  public:
    Playing(const std::string& file, Time until)
        : until_(until),
          waiting_(fmt::format("simulating {} until {:g} s", file, seconds(until))) {}

    /// Callback that updates the display; valid as long as this object exists.
    TellTime tell() {
        return [this](Time now) {
            if (until_ > start_of_run) waiting_.tell(seconds(now) / seconds(until_));
        };
    }

  private:
    Time until_;
    Waiting waiting_;
};

}  // namespace rovernet::cli
