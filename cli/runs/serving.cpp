// SPDX-License-Identifier: MIT
#include "cli/runs/serving.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "experiment/run_folder.hpp"
#include "scenario/document/quantity.hpp"
#include "scenario/scenario_file.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rovernet::cli {

std::chrono::nanoseconds time_of(const std::string& option, const std::string& text) {
    const Location where{.source = option + " " + text, .is_option = true};
    const double s = read_quantity(placed(Value(text), where), "time", Dimension::time);
    if (!(s > 0)) throw InputError(where, "expected a time above 0 s");
    return from_seconds(s);
}

std::string results_folder(const std::optional<std::string>& out, const Scenario& scenario,
                           const ScenarioOptions& options) {
    return out ? *out : run_folder(scenario, options.set);
}

void Reach::add_to(Command command) {
    const Option option = command.add_option(
        "--listen", listen,
        "serve WebSocket clients on other machines, too, at this IP address of this machine "
        "(0.0.0.0: at all addresses of this machine); the clients need the printed token");
    command
        .add_flag("--insecure", insecure,
                  "with --listen: other machines can connect by all protocols, also by those "
                  "without a token, such as Player; then everyone can drive the robots")
        .needs(option);
}

Address Reach::with_token(const std::string& text) const {
    Address address = read_loopback(text);
    if (listen) address.host = read_host(*listen);
    return address;
}

Address Reach::without_token(const std::string& text) const {
    if (insecure) return with_token(text);
    if (listen) {
        notice(
            fmt::format("{}: only programs on this machine can connect, because their protocol has "
                        "no token; with --insecure, programs on other machines can connect, too",
                        text));
    }
    return read_loopback(text);
}

StopRules ServingStop::rules() {
    return {.go_on = [] { return stops_asked() == 0; },
            .writes =
                [this](bool writes) {
                    writing_.reset();
                    if (writes) writing_.emplace();
                }};
}

std::function<void(std::string_view)> announcer(Announced announced) {
    if (announced == Announced::by_notice) return notice;
    return [](std::string_view text) {
        const bool is_address = text.starts_with("listening ") || text.starts_with("for ") ||
                                text.starts_with("page at ");
        if (!is_address) return notice(text);
        fmt::print("{}\n", text);
        std::fflush(stdout);
    };
}

}  // namespace rovernet::cli
