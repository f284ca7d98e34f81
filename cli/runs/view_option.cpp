// SPDX-License-Identifier: MIT
#include "cli/runs/view_option.hpp"

#include "cli/display/browser.hpp"

#include <utility>

namespace rovernet::cli {

Option ViewOption::add_to(Command command) {
    const Option view = command
                            .add_option("--view", address,
                                        "show the run in a browser, by a page at 127.0.0.1:PORT; "
                                        "port 0 selects a free port (default port: 0)")
                            .usually("127.0.0.1:0");
    command
        .add_flag("--view-control", control,
                  "allow the page to pause the run, to move robots and to send messages")
        .needs(view);
    command.add_flag("--open", opens, "open the page in a browser, by xdg-open").needs(view);
    return view;
}

std::function<void(std::string_view)> ViewOption::announced(
    std::function<void(std::string_view)> say) const {
    if (!opens) return say;
    return [say = std::move(say)](std::string_view text) {
        constexpr std::string_view page = "page at ";
        say(text);
        if (text.starts_with(page)) open_in_browser(std::string(text.substr(page.size())));
    };
}

FrontListeners ViewOption::listeners(const Reach& reach, ViewControl view) const {
    view.of_time = view.of_time || control;
    view.of_robots = control;
    return view_listener(reach.with_token(*address), view);
}

}  // namespace rovernet::cli
