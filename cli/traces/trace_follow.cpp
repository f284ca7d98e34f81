// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/traces/trace_commands.hpp"
#include "cli/traces/trace_notices.hpp"
#include "experiment/replay/message_at_robot.hpp"
#include "experiment/replay/recorded_follow.hpp"
#include "scenario/document/json.hpp"
#include "scenario/names.hpp"
#include "scenario/scenario_file.hpp"
#include "traces/ns2/ns2_follow.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
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
            names_ = robot_names(load_scenario(beside.string(), {}));
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
                             ? "expected the number of a robot, because the folder of the trace "
                               "has no scenario.toml with names"
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

void print_losses(const FollowedMessage& way, const TraceNames& names) {
    if (!way.lost.empty()) fmt::print("\ncopies that were lost or not forwarded:\n");
    for (const LostCopy& lost : way.lost) {
        const std::string from = lost.from ? " from " + names.of(*lost.from) : "";
        fmt::print("  after {:>12}  {} {}  at {}{}\n", milliseconds(lost.time - way.sent),
                   lost.layer, lost.reason, names.of(lost.robot), from);
    }
}

void print_without(const FollowedMessage& way, const TraceNames& names) {
    if (way.to || way.without.empty()) return;
    std::string list;
    for (const NodeId node : way.without) list += (list.empty() ? "" : ", ") + names.of(node);
    fmt::print("\nrobots without a copy: {}\n", list);
}

/// Others on air with a frame: the two strongest, and how many more.
std::string others_text(const FrameAtRobot& frame, const MessageAtRobot& message) {
    constexpr std::size_t shown = 2;
    std::string text;
    for (std::size_t i = 0; i < std::min(shown, frame.others.size()); ++i) {
        const OverlappingFrame& other = frame.others[i];
        if (i > 0) text += ", ";
        const std::string& name = message.names[other.from.index()];
        text += name == message.robot ? "its own frame"
                : other.has_level     ? fmt::format("{} {:.2f} dBm", name, other.level.value)
                                      : name;
    }
    if (frame.others.size() > shown) text += fmt::format(", {} more", frame.others.size() - shown);
    return text.empty() ? "-" : text;
}

void print_frames(const MessageAtRobot& message) {
    if (!message.frames.empty()) {
        fmt::print("\nframes of this message at {}:\n", message.robot);
        const bool has_levels = std::any_of(message.frames.begin(), message.frames.end(),
                                            [](const FrameAtRobot& f) { return !f.range; });
        TextTable table({"after", "from", has_levels ? "level" : "distance",
                         has_levels ? "margin" : "range", "walls", "outcome", "also on air"});
        for (const FrameAtRobot& f : message.frames) {
            table.add({milliseconds(f.begin - message.sent), message.names[f.from.index()],
                       f.range ? fmt::format("{:.2f} m", f.distance_m)
                               : fmt::format("{:.2f} dBm", f.level.value),
                       f.range ? fmt::format("{:.2f} m", f.range->value)
                               : fmt::format("{:+.2f} dB", f.margin.value),
                       f.walls == 0 ? "-" : fmt::format("{}, {:.2f} m", f.walls, f.wall_m),
                       outcome_text(f), others_text(f, message)});
        }
        fmt::print("{}", table.text());
    }
    fmt::print("\n{}\n", sentence(message));
}

Table robot_table(const FollowedRobot& r, const FollowedMessage& way, const TraceNames& names) {
    Array on_air;
    for (const Time t : r.on_air) on_air.emplace_back(seconds(t - way.sent));
    Table table;
    table.set("robot", names.of(r.robot));
    table.set("hops", r.hops);
    table.set("from", r.depth > 0 ? Value(names.of(r.from.value_or(way.origin))) : Value());
    table.set("after_s", seconds(r.time - way.sent));
    table.set("delivered", r.is_delivered);
    table.set("copies", r.copies);
    table.set("on_air_after_s", std::move(on_air));
    return table;
}

Table way_table(const FollowedMessage& way, const TraceNames& names) {
    Array robots, lost, without;
    for (const FollowedRobot& robot : way.robots)
        robots.emplace_back(robot_table(robot, way, names));
    for (const LostCopy& copy : way.lost) {
        Table table;
        table.set("after_s", seconds(copy.time - way.sent));
        table.set("layer", copy.layer);
        table.set("reason", copy.reason);
        table.set("robot", names.of(copy.robot));
        table.set("from", copy.from ? Value(names.of(*copy.from)) : Value());
        lost.emplace_back(std::move(table));
    }
    for (const NodeId node : way.without) without.emplace_back(names.of(node));
    Table table;
    table.set("message", way.uid);
    table.set("type", way.type);
    table.set("from", names.of(way.origin));
    table.set("to", way.to ? Value(names.of(NodeId{*way.to})) : Value());
    table.set("sent_s", seconds(way.sent));
    table.set("bytes", way.size);
    table.set("ttl", way.ttl);
    table.set("robots", std::move(robots));
    table.set("lost", std::move(lost));
    table.set("without", std::move(without));
    return table;
}

void print_json(const FollowedMessage& way, const TraceNames& names,
                const std::optional<MessageAtRobot>& there) {
    Table table = way_table(way, names);
    if (there) table.set("at_robot", document_of(*there));
    fmt::print("{}", to_json(table));
}

/// What of the way is about one robot: the way to it, and what was lost there.
FollowedMessage part_for(const FollowedMessage& way, NodeId goal) {
    const std::vector<NodeId> between = way_to(way, goal);
    FollowedMessage part = way;
    std::erase_if(part.robots, [&](const FollowedRobot& robot) {
        return std::find(between.begin(), between.end(), robot.robot) == between.end();
    });
    std::erase_if(part.lost, [&](const LostCopy& lost) { return lost.robot != goal; });
    std::erase_if(part.without, [&](NodeId node) { return node != goal; });
    return part;
}

void print_way(const FollowedMessage& way, const TraceNames& names, std::optional<NodeId> goal) {
    print_head(way, names);
    for (const FollowedRobot& robot : way.robots) print_robot(robot, way, names);
    if (goal && way.robots.empty()) fmt::print("{} received no copy\n", names.of(*goal));
    print_losses(way, names);
    if (!goal) print_without(way, names);
}

/// Frames as they came to the robot; nothing where the trace has no scenario to compute them from.
std::optional<MessageAtRobot> frames_there(const TraceFollowArguments& a, NodeId goal) {
    try {
        return message_at_robot(a.file, a.message, goal);
    } catch (const InputError& error) {
        notice(fmt::format("the table of frames and their levels is left out: {}", error.what()));
        return std::nullopt;
    }
}

}  // namespace

void trace_follow(const TraceFollowArguments& a) {
    const auto strictness = a.strict ? Ns2Strictness::strict : Ns2Strictness::tolerant;
    const bool is_recorded = is_recorded_trace(a.file);
    RecordedWay found = is_recorded
                            ? follow_recorded(a.file, a.message, strictness)
                            : RecordedWay{follow_ns2(a.file, a.message, strictness), {}, {}};
    FollowedMessage& way = found.way;
    tell_refused(a.file, way.counts);
    tell_damage(a.file, found.damage);
    const TraceNames names(a.file, found.robots);
    std::optional<NodeId> goal;
    if (a.robot) goal = names.number(*a.robot);
    if (goal) way = part_for(way, *goal);
    std::optional<MessageAtRobot> there;
    if (goal && is_recorded) there = frames_there(a, *goal);
    if (a.json) return print_json(way, names, there);
    print_way(way, names, goal);
    if (there) print_frames(*there);
}

}  // namespace rovernet::cli
