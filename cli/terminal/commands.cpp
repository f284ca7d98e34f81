// SPDX-License-Identifier: MIT
#include "cli/terminal/commands.hpp"

#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/waiting.hpp"

#include <fmt/format.h>

namespace rovernet::cli {

ScenarioOptions options_of(const FileArguments& a) {
    ScenarioOptions options = a.options;
    if (a.seed) options.set.push_back(fmt::format("scenario.seed={}", *a.seed));
    if (a.replication) {
        options.set.push_back(fmt::format("scenario.replication={}", *a.replication));
    }
    return options;
}

namespace {

void tell_of(const Scenario& scenario) {
    const Table document = to_document(scenario);
    detail(fmt::format("{} tables [[robot]], propagation model {}, {:g} s of simulated time",
                       scenario.robots.size(),
                       *document.find("propagation")->table()->find("model")->string(),
                       seconds(scenario.scenario.duration)));
}

}  // namespace

Scenario scenario_of(const FileArguments& a) {
    Scenario scenario = [&] {
        const Waiting reading("reading " + a.file);
        return load_scenario(a.file, options_of(a));
    }();
    if (tells_details()) tell_of(scenario);
    for (const std::string& text : scenario.notices) notice(text);
    return scenario;
}

}  // namespace rovernet::cli
