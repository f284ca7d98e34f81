// SPDX-License-Identifier: MIT
#include "experiment/reports/network_at.hpp"

#include "experiment/build.hpp"
#include "network/network.hpp"
#include "scenario/scenario.hpp"

#include <algorithm>

namespace rovernet {

bool somebody_reacts(const Scenario& scenario) {
    return std::any_of(scenario.robots.begin(), scenario.robots.end(),
                       [](const RobotTable& robot) { return !robot.reactions.empty(); });
}

Scenario without_idle_traffic(const Scenario& scenario) {
    Scenario quiet = scenario;
    if (!somebody_reacts(scenario)) quiet.traffic.clear();
    return quiet;
}

std::unique_ptr<Network> network_with_traffic_at(const Scenario& scenario, Time at,
                                                 const TellTime& tell) {
    auto network = std::make_unique<Network>(network_settings(scenario));
    populate(*network, scenario);
    play_until(*network, at, tell);
    return network;
}

std::unique_ptr<Network> network_at(const Scenario& scenario, Time at, const TellTime& tell) {
    return network_with_traffic_at(without_idle_traffic(scenario), at, tell);
}

}  // namespace rovernet
