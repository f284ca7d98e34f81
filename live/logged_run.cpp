// SPDX-License-Identifier: MIT
#include "live/logged_run.hpp"

#include "experiment/session.hpp"
#include "live/input_log.hpp"

#include <optional>

namespace rovernet {

RunResult run_logged(const Scenario& scenario, const std::string& folder,
                     const std::function<bool(ScenarioRun&)>& drive) {
    std::optional<InputLog> log;
    const auto drive_logged = [&](ScenarioRun& run) {
        log.emplace(folder, scenario);
        const Network& network = run.session().network();
        run.session().on_input([&](const Input& input) { log->add(input, network); });
        return drive(run);
    };
    RunResult result =
        run_scenario(scenario, {.folder = folder, .speed = std::nullopt, .drive = drive_logged});
    log->finish(result.simulated, result.fingerprint);
    return result;
}

}  // namespace rovernet
