// SPDX-License-Identifier: MIT
#include "experiment/reports/whereabouts.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

Whereabouts whereabouts_now(const Network& network, std::optional<NodeId> only) {
    Whereabouts now{network.now(), {}};
    for (NodeId node{0}; node.index() < network.size(); ++node.value) {
        if (only && node != *only) continue;
        const Leg& leg = network.legs().leg(node);
        const bool moves = now.time < leg.end;
        RobotState robot = network.robot(node);
        now.robots.push_back({std::move(robot.name), robot.at, moves ? leg.velocity : Vec3{},
                              robot.heading.value, robot.presence});
    }
    return now;
}

/// Writes down everybody's legs.
struct Recorder {
    std::vector<std::vector<Leg>> legs = {};

    KindMask kinds() const { return kind_of<Moved>(); }
    void on(const Record& record, const RecordContext&) {
        const auto* moved = std::get_if<Moved>(&record);
        if (!moved) return;
        const std::size_t i = moved->node.index();
        if (i >= legs.size()) legs.resize(i + 1);
        auto& mine = legs[i];
        if (!mine.empty() && mine.back().start == moved->time) mine.pop_back();
        if (!mine.empty()) end(mine.back(), moved->time);
        mine.push_back(moved->leg);
    }

  private:
    /// Cuts a leg that was interrupted, or lengthens its rest at the end.
    static void end(Leg& leg, Time t) {
        if (t >= leg.end) return;
        leg.to = leg.position(t);
        leg.end = t;
    }
};

/// Notice that robots have other names in a movement file, of which the first three are shown;
/// empty if no name is different. @param numbers  of the robots in the file
std::string renaming_notice(const std::string& path, const std::vector<Track>& all,
                            const std::vector<std::uint32_t>& numbers) {
    constexpr std::size_t most = 3;
    std::vector<std::string> changes;
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string name = fmt::format("n{}", numbers[i]);
        if (all[i].name == name || ++count > most) continue;
        changes.push_back(fmt::format("{} is {}", all[i].name, name));
    }
    if (changes.empty()) return {};
    return fmt::format("{}: in this format, robots have numbers instead of names: {}{}", path,
                       fmt::join(changes, ", "),
                       count > most ? fmt::format(", and {} more", count - most) : "");
}

}  // namespace

std::vector<Whereabouts> whereabouts(const Scenario& scenario, const std::vector<Time>& times,
                                     const std::optional<std::string>& robot,
                                     const TellTime& tell) {
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    const Scenario played = without_idle_traffic(scenario);
    Network network(network_settings(played));
    populate(network, played);
    const auto only = robot ? std::optional(robot_named(network, *robot)) : std::nullopt;
    std::vector<Whereabouts> all(times.size());
    for (const std::size_t i : order) {
        play_until(network, times[i], tell);
        all[i] = whereabouts_now(network, only);
    }
    return all;
}

std::vector<Track> tracks(const Scenario& scenario, const TellTime& tell) {
    const Scenario played = without_idle_traffic(scenario);
    Network network(network_settings(played));
    populate(network, played);
    const auto recorder = std::make_shared<Recorder>();
    network.add_sink(recorder);
    play_until(network, start_of_run + scenario.scenario.duration, tell);
    std::vector<Track> all;
    recorder->legs.resize(network.size());
    for (std::uint32_t i = 0; i < network.size(); ++i) {
        all.push_back({network.name(NodeId{i}), std::move(recorder->legs[i])});
    }
    return all;
}

std::vector<OutputFile> movement_files(const Scenario& scenario, const std::string& path,
                                       std::vector<std::string>& notices, const TellTime& tell) {
    const std::filesystem::path out(path);
    const std::string ending = out.extension().string();
    const bool is_ns2 = ending == ".tcl" || ending == ".ns_movements";
    if (!is_ns2 && ending != ".movements") {
        throw std::invalid_argument(
            fmt::format("{}: unknown ending \"{}\"; expected .tcl or .ns_movements for ns-2, "
                        ".movements for BonnMotion",
                        path, ending));
    }
    const Time end = start_of_run + scenario.scenario.duration;
    const auto all = tracks(scenario, tell);
    std::vector<std::uint32_t> numbers = node_numbers(all);
    if (!is_ns2) std::iota(numbers.begin(), numbers.end(), 0U);  // of lines
    std::string notice = renaming_notice(path, all, numbers);
    if (!notice.empty()) notices.push_back(std::move(notice));
    if (is_ns2) return {{path, setdest_text(all, end)}};
    std::filesystem::path params(out);
    return {{path, bonnmotion_text(all, end)},
            {params.replace_extension(".params").string(), bonnmotion_params(all, end)}};
}

}  // namespace rovernet
