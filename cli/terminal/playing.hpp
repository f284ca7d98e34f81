// SPDX-License-Identifier: MIT
#pragma once

#include "cli/terminal/waiting.hpp"
#include "experiment/playing.hpp"

#include <fmt/format.h>

#include <string>

namespace rovernet::cli {

/// Shows how far a scenario is that is played until a time, as Waiting does.
class Playing {
  public:
    Playing(const std::string& file, Time until)
        : until_(until), waiting_(fmt::format("playing {} until {:g} s", file, seconds(until))) {}

    /// Valid as long as this object.
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
