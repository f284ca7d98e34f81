// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/serving.hpp"
#include "cli/terminal/command_line.hpp"
#include "live/viewer/view_front.hpp"

#include <optional>
#include <string>

namespace rovernet::cli {

/// Options --view and --view-control of a command that runs a scenario: a page that shows the run.
struct ViewOption {
    std::optional<std::string> address;
    bool control = false;

    /// Adds the options to a command. @return the option --view
    Option add_to(Command command);
    bool is_given() const { return address.has_value(); }
    /// Listeners of the page.
    /// @param view  what the page may do without --view-control
    FrontListeners listeners(const Reach& reach, ViewControl view) const;
};

}  // namespace rovernet::cli
