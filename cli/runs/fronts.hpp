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

/// Options of the commands live and emulate that each start a front: a server for one network
/// protocol of external programs, such as rosbridge.
inline constexpr std::array front_options = {
    &rosbridge_option,
};

/// Values of the options that start fronts (protocol servers): for each front the listening
/// address; none if its option is not given.
struct FrontArguments {
    std::array<std::optional<std::string>, front_options.size()> addresses;

    /// Adds the options of all fronts to a command. @return the added options
    std::vector<Option> add_to(Command command);
    bool any() const;
    /// Appends to `fronts` the listeners of each front whose option is given.
    void append_to(std::vector<FrontListeners>& fronts, const Reach& reach) const;
};

}  // namespace rovernet::cli
