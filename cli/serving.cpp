// SPDX-License-Identifier: MIT
#include "cli/serving.hpp"

#include "cli/diagnostics.hpp"
#include "cli/stop.hpp"
#include "experiment/run_folder.hpp"
#include "scenario/quantity.hpp"

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

bool goes_on() { return stops_asked() == 0; }

void say_to_all(std::string_view text) {
    // Programs read the address from standard output, before there is any result.
    if (!text.starts_with("listening")) return notice(text);
    fmt::print("{}\n", text);
    std::fflush(stdout);
}

}  // namespace rovernet::cli
