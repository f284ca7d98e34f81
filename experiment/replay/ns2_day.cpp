// SPDX-License-Identifier: MIT
#include "experiment/replay/ns2_day.hpp"

#include "experiment/movement_play.hpp"
#include "scenario/document/toml.hpp"
#include "sim/error.hpp"
#include "traces/metrics.hpp"
#include "traces/ns2/ns2_motion.hpp"
#include "traces/ns2/ns2_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace rovernet {
namespace {

/// Collects the log of a day from the lines of an ns-2 trace.
class Ns2DayReader {
  public:
    explicit Ns2DayReader(DayRouting routing) : routing_(routing) {}

    KindMask kinds() const { return metrics_.kinds() | deliveries_.kinds() | kind_of<Moved>(); }
    void on(const Record& record, const RecordContext& context) {
        const KindMask kind = KindMask{1} << record.index();
        if (metrics_.kinds() & kind) metrics_.on(record, context);
        if (deliveries_.kinds() & kind) deliveries_.on(record, context);
        if (const auto* received = std::get_if<Received>(&record)) hear(*received);
        const auto* moved = std::get_if<Moved>(&record);
        if (!moved) return;
        know(moved->node, moved->time);
        motion_.begins(moved->node, moved->leg);
    }
    void on(const Ns2Packet& packet, const Message* message) {
        know(packet.node, packet.time);
        if (packet.position) motion_.is_at(packet.node, packet.time, *packet.position);
        if (message && packet.layer == "AGT" && packet.op == 's') say(packet, *message);
    }

    std::vector<std::vector<Leg>> legs() const {
        std::vector<std::vector<Leg>> legs(robots_);
        for (NodeId n{0}; n.value < robots_; ++n.value) legs[n.index()] = motion_.legs(n);
        return legs;
    }
    PlayedDay recorded() const { return {metrics_.values(), deliveries_.all}; }
    Time end() const { return end_; }
    /// Sentence about dropped messages; empty: none.
    std::string left_out() const {
        if (left_out_ == 0) return "";
        return fmt::format(
            "{} messages are left out, because each of them was sent to its own sender, or to a "
            "robot that is not in the trace",
            left_out_);
    }
    std::vector<DayLog::Said> said;
    std::vector<DayLog::Heard> heard;

  private:
    void know(NodeId node, Time time) {
        robots_ = std::max(robots_, node.value + 1);
        end_ = std::max(end_, time);
    }
    void hear(const Received& received) {
        for (const Reception& each : received.receptions) {
            if (each.node == received.frame.sender || !is_decoded(each.fate)) continue;
            heard.push_back({each.time, received.frame.sender, each.node});
        }
    }
    void say(const Ns2Packet& packet, const Message& message) {
        const bool is_for_one = packet.ip && packet.ip->to >= 0;
        const bool is_for_no_robot = is_for_one && message.to == everyone;
        if (is_for_no_robot || message.to == message.origin) {
            ++left_out_;
            return;
        }
        if (is_for_one) know(message.to, packet.time);
        said.push_back({packet.time, message});
        said.back().message.is_routed = routing_ == DayRouting::flood;
    }

    DayRouting routing_;
    Metrics metrics_;
    Deliveries deliveries_;
    Ns2Motion motion_;
    std::uint32_t robots_ = 0;
    Time end_ = start_of_run;
    std::uint64_t left_out_ = 0;
};

std::string robot_name(std::size_t robot) { return fmt::format("n{}", robot); }

/// Number of a robot in its name, "n7"; nothing for another name.
std::optional<std::uint32_t> robot_number(const std::string& name) {
    const std::string digits = name.substr(std::min<std::size_t>(1, name.size()));
    const bool is_number =
        name.starts_with('n') && !digits.empty() && digits.size() < 8 &&
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_number) return std::nullopt;
    return static_cast<std::uint32_t>(std::stoul(digits));
}

/// Reads legs from a movement file, by playing it in a network without traffic.
void take_movements(const std::string& path, Time end, DayLog& log) {
    MovementFile file(path);
    Network network;
    std::vector<NodeId> nodes;
    std::vector<std::optional<NodeId>> numbers;
    for (const FileRobot& robot : file.robots()) {
        nodes.push_back(network.add({.name = robot.name, .at = robot.start}));
        const auto number = robot_number(robot.name);
        numbers.push_back(number ? std::optional(NodeId{*number}) : std::nullopt);
        if (number && *number >= log.legs.size()) log.legs.resize(*number + 1);
    }
    DayLog played;
    network.add_sink(DayLogSink{played});
    play(network, std::move(file), nodes);
    network.run_until(end);
    for (std::size_t i = 0; i < played.legs.size(); ++i) {
        if (numbers[i]) log.legs[numbers[i]->index()] = std::move(played.legs[i]);
    }
    for (const DayLog::Turned& turned : played.turned) {
        const auto number = numbers[turned.node.index()];
        if (number) log.turned.push_back({turned.time, *number, turned.on});
    }
}

/// @throws InputError if it is not known where some robot is
void check_places(const std::string& path, const Ns2DayOptions& options, const DayLog& log) {
    std::vector<std::size_t> unknown;
    constexpr double farthest = 1e9;  // [m], the longest length of a scenario
    const auto is_far = [](Vec3 at) {
        return !(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) <= farthest);
    };
    for (std::size_t i = 0; i < log.legs.size(); ++i) {
        if (log.legs[i].empty()) unknown.push_back(i);
        for (const Leg& leg : log.legs[i]) {
            if (!is_far(leg.from) && !is_far(leg.to)) continue;
            throw InputError({path}, fmt::format("robot {} is at a position more than 1e9 m from "
                                                 "the origin; expected at most 1e9 m",
                                                 i));
        }
    }
    if (unknown.empty()) return;
    const std::string names =
        unknown.size() == 1 ? fmt::format("robot {}", unknown[0])
                            : fmt::format("robot {} and {} more", unknown[0], unknown.size() - 1);
    if (options.movements) {
        throw InputError(
            {*options.movements},
            fmt::format("found no position of {}; expected the positions of all robots in {}",
                        names, path));
    }
    throw InputError(
        {path}, fmt::format("found no position of {}: an ns-2 trace in the old format has no "
                            "position of a robot that never moves; expected --movements FILE.tcl",
                            names));
}

/// Scenario with the radio that ns-2 has by default.
Table ns2_scenario(const DayLog& log, Time end, DayRouting routing) {
    const auto section = [](std::initializer_list<std::pair<const char*, const char*>> entries) {
        Table table;
        for (const auto& [key, value] : entries) table.set(key, value);
        return table;
    };
    Table document, scenario, protocol;
    scenario.set("name", "ns2");
    scenario.set("duration", fmt::format("{} ns", (end - start_of_run).count() + 1'000'000'000));
    document.set("scenario", std::move(scenario));
    // 0.28183815 W, RXThresh_ 3.652e-10 W, CSThresh_ 1.559e-11 W: ns-default.tcl of ns-2.35.
    document.set("radio", section({{"power", "24.49999779 dBm"},
                                   {"sensitivity", "-64.37439 dBm"},
                                   {"carrier_sense_threshold", "-78.07154 dBm"},
                                   {"frequency", "914 MHz"},
                                   {"antenna_height", "1.5 m"},
                                   {"rate", "1 Mbit/s"}}));
    document.set("propagation", section({{"model", "two_ray"}}));
    document.set("reception", section({{"model", "collision"}, {"capture_ratio", "10 dB"}}));
    // 20 bytes of IP, 34 of Mac/802_11.
    document.set(
        "access",
        section(
            {{"model", "csma"}, {"eifs", "ns2"}, {"header", "54 B"}, {"rts_threshold", "0 B"}}));
    constexpr std::int64_t default_ttl_of_ip = 32;
    protocol.set("protocol", "flood");
    protocol.set("ttl", routing == DayRouting::flood ? default_ttl_of_ip : 1);
    document.set("routing", std::move(protocol));
    Array robots;
    for (std::size_t i = 0; i < log.legs.size(); ++i) {
        const Vec3 at = log.legs[i].front().from;
        Table robot;
        robot.set("name", robot_name(i));
        const auto metres = [](double v) { return fmt::format("{} m", v); };
        robot.set("at", Array{metres(at.x), metres(at.y), metres(at.z)});
        robots.emplace_back(std::move(robot));
    }
    document.set("robot", std::move(robots));
    return document;
}

}  // namespace

RecordedDay read_ns2_day(const std::string& path, const Ns2DayOptions& options) {
    const auto reader = std::make_shared<Ns2DayReader>(options.routing);
    const Ns2Counts counts = read_ns2_trace(
        path, reader, Ns2Strictness::tolerant,
        [&](const Ns2Packet& packet, const Message* message) { reader->on(packet, message); });
    DayLog log;
    log.legs = reader->legs();
    if (log.legs.empty()) throw InputError({path}, "there is no robot in this trace");
    if (options.movements) {
        log.legs.assign(log.legs.size(), {});
        take_movements(*options.movements, reader->end(), log);
    }
    check_places(path, options, log);
    log.said = std::move(reader->said);
    log.heard = std::move(reader->heard);
    log.recorded = reader->recorded();
    if (counts.refused > 0)
        log.notices.push_back(fmt::format(
            "{} of {} lines are not in ns-2 format and are left out; the first is line {}",
            counts.refused, counts.lines, counts.refused_lines.front().line));
    if (const std::string text = reader->left_out(); !text.empty()) log.notices.push_back(text);
    RecordedRun run;
    run.scenario = to_toml(ns2_scenario(log, reader->end(), options.routing));
    for (std::size_t i = 0; i < log.legs.size(); ++i) run.robots.push_back(robot_name(i));
    return RecordedDay(std::move(run), path, std::move(log));
}

}  // namespace rovernet
