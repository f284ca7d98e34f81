// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "cli/trace_notices.hpp"
#include "experiment/trace_input.hpp"
#include "scenario/scenario.hpp"
#include "traces/ns2/ns2_follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace rovernet::cli {
namespace {

/// Names of the robots of a trace: its own, or those of the scenario beside it, or else their
/// numbers.
class TraceNames {
  public:
    /// @param recorded  names that the trace itself has
    TraceNames(const std::string& trace, const std::vector<std::string>& recorded)
        : names_(recorded) {
        if (!names_.empty()) return;
        const auto beside = std::filesystem::path(trace).parent_path() / "scenario.toml";
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(beside, ignored)) return;
        try {
            for (const RobotTable& robot : load_scenario(beside.string(), {}).robots) {
                for (int i = 0; i < robot.count.value_or(1); ++i) {
                    names_.push_back(robot.name_of(i));
                }
            }
        } catch (const InputError&) {
            names_.clear();  // the trace can be told by numbers
        }
    }
    std::string of(NodeId node) const {
        return node.index() < names_.size() ? names_[node.index()]
                                            : fmt::format("robot {}", node.value);
    }
    NodeId number(const std::string& name) const {
        const auto found = std::find(names_.begin(), names_.end(), name);
        if (found != names_.end()) return {static_cast<std::uint32_t>(found - names_.begin())};
        NodeId node{0};
        const char* end = name.data() + name.size();
        const auto [stop, error] = std::from_chars(name.data(), end, node.value);
        if (error == std::errc{} && stop == end) return node;
        const std::string hint = did_you_mean(name, names_);
        throw InputError({"--robot " + name, 0, 0, true},
                         names_.empty()
                             ? "expected a robot's number, as no scenario.toml with names "
                               "is beside the trace"
                             : "no robot has this name" + (hint.empty() ? hint : "; " + hint));
    }

  private:
    std::vector<std::string> names_;
};

std::string milliseconds(Duration d) { return fmt::format("{:.3f} ms", seconds(d) * 1e3); }

/// The robots between the origin and `robot`, both included, by the tree.
std::vector<NodeId> way_to(const FollowedMessage& way, NodeId robot) {
    std::vector<NodeId> between;
    for (std::size_t i = way.robots.size(); i-- > 0;) {
        if (way.robots[i].robot != robot) continue;
        between.push_back(robot);
        robot = way.robots[i].from.value_or(way.origin);
    }
    return between;
}

void print_head(const FollowedMessage& way, const TraceNames& names) {
    const std::string to = way.to ? names.of(NodeId{*way.to}) : "everybody";
    fmt::print("{} {} of {} for {}, sent at {:.9f} s: {} bytes, ttl {}\n\n", way.type, way.uid,
               names.of(way.origin), to, seconds(way.sent), way.size, way.ttl);
}

void print_robot(const FollowedRobot& r, const FollowedMessage& way, const TraceNames& names) {
    std::string line(2 * static_cast<std::size_t>(r.depth), ' ');
    line += names.of(r.robot);
    if (r.depth > 0) {
        line += fmt::format("  from {} after {}", names.of(r.from.value_or(way.origin)),
                            milliseconds(r.time - way.sent));
        if (r.is_delivered) line += ", delivered";
        if (r.copies > 1) line += fmt::format(", {} copies", r.copies);
    }
    for (const Time t : r.on_air)
        line += fmt::format(", on air after {}", milliseconds(t - way.sent));
    if (r.on_air.empty() && r.depth == 0) line += ", never on air";
    fmt::print("{}\n", line);
}

void print_losses(const FollowedMessage& way, const TraceNames& names, std::optional<NodeId> at) {
    bool is_first = true;
    for (const LostCopy& lost : way.lost) {
        if (at && lost.robot != *at) continue;
        if (is_first) fmt::print("\ncopies that went no further:\n");
        is_first = false;
        const std::string from = lost.from ? " from " + names.of(*lost.from) : "";
        fmt::print("  after {:>12}  {} {}  at {}{}\n", milliseconds(lost.time - way.sent),
                   lost.layer, lost.reason, names.of(lost.robot), from);
    }
}

void print_without(const FollowedMessage& way, const TraceNames& names) {
    if (way.to || way.without.empty()) return;
    std::string list;
    for (const NodeId node : way.without) list += (list.empty() ? "" : ", ") + names.of(node);
    fmt::print("\nwithout a copy: {}\n", list);
}

}  // namespace

void trace_follow(const TraceFollowArguments& a) {
    const auto strictness = a.strict ? Ns2Strictness::strict : Ns2Strictness::tolerant;
    const TraceInput trace(a.file, {.format = Ns2Format::old_format, .mac = MacTrace::on});
    const FollowedMessage way = follow_ns2(trace.text(), a.message, strictness);
    tell_refused(a.file, way.counts);
    tell_damage(a.file, trace.damage());
    const TraceNames names(a.file, trace.robots());
    std::optional<NodeId> goal;
    if (a.robot) goal = names.number(*a.robot);
    print_head(way, names);
    const std::vector<NodeId> between = goal ? way_to(way, *goal) : std::vector<NodeId>{};
    for (const FollowedRobot& robot : way.robots) {
        const bool is_on_way =
            std::find(between.begin(), between.end(), robot.robot) != between.end();
        if (!goal || is_on_way) print_robot(robot, way, names);
    }
    if (goal && between.empty()) fmt::print("{} received no copy\n", names.of(*goal));
    print_losses(way, names, goal);
    if (!goal) print_without(way, names);
}

}  // namespace rovernet::cli
