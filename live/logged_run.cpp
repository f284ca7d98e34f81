// SPDX-License-Identifier: MIT
#include "live/logged_run.hpp"

#include "experiment/session.hpp"
#include "live/input_log.hpp"

namespace rovernet {
namespace {

/// Serves the events of the start, of which each may plan a robot's way. @return false if stopped
bool reach_start(Session& session, const StopRules& stop) {
    constexpr std::uint64_t events_a_slice = 4;
    while (!session.advance(start_of_run, events_a_slice)) {
        if (!stop.go_on()) return false;
    }
    return true;
}

}  // namespace

RunResult run_logged(const Scenario& scenario, const std::string& folder, const StopRules& stop,
                     const std::function<void(ScenarioRun&)>& prepare,
                     const std::function<bool(ScenarioRun&, InputLog&)>& drive) {
    std::optional<InputLog> log;
    const auto drive_logged = [&](ScenarioRun& run) {
        prepare(run);
        if (!reach_start(run.session(), stop)) return false;
        log.emplace(folder, scenario);
        const Network& network = run.session().network();
        run.session().on_input([&](const Input& input) { log->add(input, network); });
        const bool is_whole = drive(run, *log);
        if (!is_whole) log->discard();
        return is_whole;
    };
    const auto begin = [&](double) {
        stop.writes(true);
        return stop.go_on();
    };
    stop.writes(false);
    RunResult result = run_scenario(
        scenario,
        {.folder = folder, .speed = std::nullopt, .progress = begin, .drive = drive_logged});
    log->finish(result.simulated, result.fingerprint);
    return result;
}

}  // namespace rovernet
