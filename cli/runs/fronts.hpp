// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/serving.hpp"
#include "cli/terminal/command_line.hpp"
#include "live/paced_run.hpp"
#include "live/rosbridge/listener.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rovernet::cli {

/// Fronts that the commands live and emulate serve at an address, each by its option.
inline constexpr std::array front_options = {
    &rosbridge_option,
};

/// Options for the fronts that are served.
struct FrontArguments {
    std::array<std::optional<std::string>, front_options.size()> addresses;

    /// Adds the options to a command. @return the options
    std::vector<Option> add_to(Command command);
    bool any() const;
    /// Adds the listeners of the fronts that were asked for.
    void append_to(std::vector<FrontListeners>& fronts, const Reach& reach) const;
};

}  // namespace rovernet::cli
