// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_head.hpp"

#include "models/link_gain.hpp"
#include "models/propagation/list.hpp"
#include "network/robot.hpp"
#include "pictures/viewer/view_map.hpp"
#include "scenario/scenario.hpp"
#include "sim/fate.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace rovernet {
namespace {

/// Gains [dB] of an antenna, against its largest one, in directions 5 degrees apart,
/// counter-clockwise from the robot's heading.
std::vector<double> antenna_pattern(const Radio& radio) {
    constexpr int directions = 72;
    constexpr double least_db = -100;  // JSON has no infinity
    std::vector<double> gains;
    for (int i = 0; i < directions; ++i) {
        const auto [sin, cos] = math::sincos(2 * std::numbers::pi * i / directions);
        gains.push_back(std::max(least_db, pattern_gain(radio, {}, {cos, sin, 0}).value));
    }
    return gains;
}

/// Descriptions of the robots; patterns of directional antennas are appended to `antennas`, each
/// once.
Array robot_list(const std::vector<std::string>& names, const Scenario& scenario, Array& antennas) {
    std::map<std::vector<double>, std::size_t> numbers;
    const auto number_of = [&](const Radio& radio) {
        const auto [found, is_new] = numbers.emplace(antenna_pattern(radio), antennas.size());
        if (is_new) antennas.emplace_back(Array(found->first.begin(), found->first.end()));
        return std::uint64_t{found->second};
    };
    std::map<std::string, const RobotTable*> tables;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) tables.emplace(table.name_of(i), &table);
    }
    const Propagation common = scenario.propagation.make();
    Array list;
    for (const std::string& name : names) {
        const auto found = tables.find(name);
        const bool is_listed = found != tables.end();  // else it is of a movement file
        const Radio& radio = is_listed ? found->second->radio : scenario.radio;
        Table robot;
        robot.set("name", name);
        robot.set("radius", (is_listed ? found->second->radius : Robot{}.radius).value);
        const bool has_own = is_listed && found->second->propagation;
        robot.set("model", has_own ? found->second->propagation->make().name() : common.name());
        robot.set("power_dbm", radio.power.value);
        robot.set("sensitivity_dbm", radio.sensitivity.value);
        robot.set("antenna_z", radio.antenna_height.value);
        if (radio.is_directional()) robot.set("antenna", number_of(radio));
        list.emplace_back(std::move(robot));
    }
    return list;
}

/// Fates in the words of the page, in the order of the enumeration.
constexpr std::array words_of_fate{"received, to be forwarded",
                                   "received, TTL used up",
                                   "received again",
                                   "robot was off",
                                   "bit errors",
                                   "collision",
                                   "robot was sending",
                                   "received"};
static_assert(words_of_fate.size() == static_cast<std::size_t>(last_fate) + 1);

Array outcome_list() {
    Array list;
    for (const char* words : words_of_fate) {
        list.emplace_back(words);
        list.emplace_back(fmt::format("{}, delivered", words));
    }
    return list;
}

Array model_list() {
    Array list;
    for_each_model([&]<class Model>() { list.emplace_back(Model::name); });
    return list;
}

Array flow_list(const Scenario& scenario) {
    Array list{""};
    for (const TrafficTable& table : scenario.traffic) list.emplace_back(table.name);
    return list;
}

}  // namespace

Table view_head(const Scenario& scenario, const std::vector<std::string>& robots,
                std::string_view version) {
    Table head;
    head.set("rvw", 1);
    head.set("version", version);
    head.set("name", scenario.scenario.name);
    head.set("seed", scenario.scenario.seed);
    head.set("replication", scenario.scenario.replication);
    constexpr std::int64_t longest = (std::int64_t{1} << 53U) - 1;  // exact in JavaScript
    head.set("duration_ns", std::min<std::int64_t>(scenario.scenario.duration.count(), longest));
    Array antennas;
    head.set("robots", robot_list(robots, scenario, antennas));
    head.set("antennas", std::move(antennas));
    head.set("colors", view_colors());
    head.set("models", model_list());
    head.set("outcomes", outcome_list());
    head.set("flows", flow_list(scenario));
    return head;
}

}  // namespace rovernet
