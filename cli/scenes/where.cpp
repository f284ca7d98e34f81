// SPDX-License-Identifier: MIT
#include "cli/scenes/presence_text.hpp"
#include "cli/scenes/scene_commands.hpp"
#include "cli/terminal/playing.hpp"
#include "cli/terminal/text_table.hpp"
#include "experiment/reports/link_gaps.hpp"
#include "experiment/reports/patrol_round.hpp"
#include "experiment/reports/whereabouts.hpp"
#include "scenario/document/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rovernet::cli {
namespace {

/// Legs of the robot until the end of the run; none for an unknown robot.
Track track_of(const Scenario& scenario, const std::string& file, const std::string& robot) {
    Playing playing(file, start_of_run + scenario.scenario.duration);
    for (Track& track : tracks(scenario, playing.tell()))
        if (track.name == robot) return std::move(track);
    return {};
}

/// Times at which the robot begins a leg of its path, and the end of the run.
std::vector<Time> leg_times(const Scenario& scenario, const Track& track) {
    std::vector<Time> times;
    for (const Leg& leg : track.legs) times.push_back(leg.start);
    times.push_back(start_of_run + scenario.scenario.duration);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

Table robot_document(const Whereabouts::Row& robot) {
    Table out;
    out.set("name", robot.name);
    out.set("x_m", robot.position.x);
    out.set("y_m", robot.position.y);
    out.set("z_m", robot.position.z);
    out.set("vx", robot.velocity.x);
    out.set("vy", robot.velocity.y);
    out.set("heading_rad", robot.heading);
    out.set("presence", name_of(robot.presence));
    return out;
}

void print_text(const std::vector<Whereabouts>& all, const std::optional<PatrolRound>& round) {
    for (const Whereabouts& now : all) {
        for (const auto& [name, p, v, heading, presence] : now.robots) {
            fmt::print(
                "{:>12.6f} s  {:<12} at ({:.6f}, {:.6f}, {:.6f}) m, {:.6f} m/s, heading "
                "{:.6f} rad{}\n",
                seconds(now.time), name, p.x, p.y, p.z, distance(v, {}), heading,
                presence_text(name_of(presence)));
        }
    }
    if (!round) return;
    fmt::print(
        "a round of the patrol, through all {} places, takes {:.6f} s (the last round begins at "
        "{:.6f} s)\n",
        round->places, seconds(round->length), seconds(round->begin));
}

void print_json(const std::vector<Whereabouts>& all, const std::optional<PatrolRound>& round) {
    Array list;
    for (const Whereabouts& now : all) {
        Array robots;
        for (const Whereabouts::Row& robot : now.robots) robots.push_back(robot_document(robot));
        Table at;
        at.set("t_s", seconds(now.time));
        at.set("robots", std::move(robots));
        list.emplace_back(std::move(at));
    }
    Table document;
    document.set("times", std::move(list));
    if (round) document.set("round_s", seconds(round->length));
    fmt::print("{}", to_json(document));
}

std::string place_text(Vec3 p, bool has_heights) {
    return has_heights ? fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x, p.y, p.z)
                       : fmt::format("({:.2f}, {:.2f})", p.x, p.y);
}

void print_gaps(const LinkGapsQuestion& question, const LinkGaps& gaps) {
    fmt::print("{}\n", link_gaps_text(question, gaps));
    if (gaps.gaps.empty()) return;
    const bool has_heights = std::any_of(gaps.gaps.begin(), gaps.gaps.end(), [](const LinkGap& g) {
        return g.from.z != 0 || g.to.z != 0;
    });
    TextTable table(
        {"begin [s]", "end [s]", "lasts [s]", "path [m]", "begins at [m]", "ends at [m]"});
    for (const LinkGap& gap : gaps.gaps) {
        table.add({fmt::format("{:.3f}", seconds(gap.begin)),
                   fmt::format("{:.3f}", seconds(gap.end)),
                   fmt::format("{:.3f}", seconds(gap.length())), fmt::format("{:.2f}", gap.path),
                   place_text(gap.from, has_heights), place_text(gap.to, has_heights)});
    }
    fmt::print("{}", table.text());
}

void where_without_link(const WhereArguments& a) {
    const Scenario scenario = scenario_of(a);
    const LinkGapsQuestion question{.robot = *a.robot, .partners = a.to, .relays = a.over};
    const LinkGaps gaps = [&] {
        Playing playing(a.file, start_of_run + scenario.scenario.duration);
        return link_gaps(scenario, question, playing.tell());
    }();
    if (a.json) {
        fmt::print("{}", to_json(link_gaps_document(question, gaps)));
    } else if (a.csv) {
        fmt::print("{}{}", link_gaps_csv_head, link_gaps_csv(gaps));
    } else {
        print_gaps(question, gaps);
    }
}

}  // namespace

void where(const WhereArguments& a) {
    if (!a.to.empty()) return where_without_link(a);
    if (a.at.empty() && !a.robot) {
        throw std::invalid_argument(
            "where: found neither a time nor a robot; expected --at 10s,20s (all robots at these "
            "times), "
            "--robot NAME (its path), or --robot NAME --to NAME (the gaps in its link)");
    }
    const Scenario scenario = scenario_of(a);
    std::vector<Time> times;
    for (const std::string& text : a.at) times.push_back(time_in(scenario, text));
    std::optional<PatrolRound> round;
    if (times.empty()) {
        const Track track = track_of(scenario, a.file, *a.robot);
        times = leg_times(scenario, track);
        round = patrol_round(scenario, track);
    }
    const auto all = [&] {
        Playing playing(a.file, *std::max_element(times.begin(), times.end()));
        return whereabouts(scenario, times, a.robot, playing.tell());
    }();
    a.json ? print_json(all, round) : print_text(all, round);
}

}  // namespace rovernet::cli
