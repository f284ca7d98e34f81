// SPDX-License-Identifier: MIT
#pragma once

#include "cli/runs/serving.hpp"
#include "cli/terminal/command_line.hpp"
#include "live/viewer/view_front.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rovernet::cli {

/// Options --view, --view-control and --open, by which a command that runs a scenario shows the run
/// on a web page.
struct ViewOption {
    std::optional<std::string> address;
    bool control = false, opens = false;

    /// Adds the options to a command. @return the option --view
    Option add_to(Command command);
    bool is_given() const { return address.has_value(); }
    /// Function that passes each message to `say`. With --open, the function also opens the page in
    /// the browser when the message contains the page's address.
    std::function<void(std::string_view)> announced(
        std::function<void(std::string_view)> say) const;
    /// Listeners of the page.
    /// @param view  rights of the page without --view-control
    FrontListeners listeners(const Reach& reach, ViewControl view) const;
};

}  // namespace rovernet::cli
