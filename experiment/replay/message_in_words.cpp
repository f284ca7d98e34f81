// SPDX-License-Identifier: MIT
// Texts of a MessageAtRobot: its sentence, and its document.
#include "experiment/replay/message_at_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <utility>

namespace rovernet {
namespace {

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string walls_in_words(const MessageAtRobot& message, const FrameAtRobot& frame) {
    if (!message.has_walls || !message.tells_walls) return "";
    if (frame.walls == 0) return ", with no wall between";
    return ", through " + counted(frame.walls, "wall");
}

using FrameList = std::vector<const FrameAtRobot*>;

FrameList with_outcome(const MessageAtRobot& message, std::initializer_list<Outcome> outcomes) {
    FrameList found;
    for (const FrameAtRobot& frame : message.frames) {
        const bool is_one =
            std::find(outcomes.begin(), outcomes.end(), frame.outcome) != outcomes.end();
        if (is_one) found.push_back(&frame);
    }
    return found;
}

std::string received_in_words(const MessageAtRobot& message, const FrameAtRobot& first) {
    const std::string how =
        first.range
            ? fmt::format("came over {:.6g} m, within the sender's range of {:.6g} m",
                          first.distance_m, first.range->value)
            : fmt::format("came at {:.2f} dBm, {:.1f} dB above the sensitivity of the receiver",
                          first.level.value, first.margin.value);
    return fmt::format(
        "{} received the message from {}, {:.3f} ms after the message was sent: the frame {}{}.",
        message.robot, message.names[first.from.index()], seconds(first.end - message.sent) * 1e3,
        how, walls_in_words(message, first));
}

std::string weak_in_words(const MessageAtRobot& message, const FrameList& weak) {
    // The strongest frame; without levels, the frame that came nearest to its range.
    const auto margin = [](const FrameAtRobot& frame) {
        return frame.range ? frame.range->value - frame.distance_m : frame.margin.value;
    };
    const FrameAtRobot& best =
        **std::max_element(weak.begin(), weak.end(),
                           [&](const auto* a, const auto* b) { return margin(*a) < margin(*b); });
    const bool is_one = weak.size() == 1;
    const std::size_t off = with_outcome(message, {Outcome::off}).size();
    return fmt::format(
        "{} was never in range: {} {}{}{}.", message.robot,
        is_one
            ? "the only frame"
            : fmt::format("the {} of {} frames", best.range ? "nearest" : "strongest", weak.size()),
        best.range ? fmt::format("came from {:.6g} m, beyond the sender's range of {:.6g} m",
                                 best.distance_m, best.range->value)
                   : fmt::format("came {:.1f} dB below the sensitivity of the receiver",
                                 -best.margin.value),
        walls_in_words(message, best),
        off > 0 ? fmt::format("; {} of the other frames came while the robot was off", off) : "");
}

std::string lost_in_words(const MessageAtRobot& message, const FrameList& lost) {
    constexpr std::pair<Outcome, std::string_view> causes[] = {
        {Outcome::collided, "while other frames were on air"},
        {Outcome::busy, "while the robot itself was sending"},
        {Outcome::garbled, "because of bit errors"},
        {Outcome::not_told,
         "for an unknown reason, because the end of the frame is not in the trace"}};
    std::string list;
    for (const auto& [outcome, words] : causes) {
        const std::size_t count = with_outcome(message, {outcome}).size();
        if (count == 0) continue;
        list += list.empty() ? ": " : ", ";
        list += lost.size() == 1 ? std::string(words) : fmt::format("{} {}", count, words);
    }
    return fmt::format("{} was in range of {} of {}, but lost {}{}.", message.robot, lost.size(),
                       counted(message.frames.size(), "frame"), lost.size() == 1 ? "it" : "them",
                       list);
}

/// Why a unicast did not reach a robot to which none of its frames was sent; empty: it is no such
/// unicast.
std::string unicast_in_words(const MessageAtRobot& message) {
    if (message.to == everyone) return "";
    const bool is_next_hop = std::ranges::any_of(message.frames, [&](const FrameAtRobot& frame) {
        return frame.next_hop != everyone && message.names[frame.next_hop.index()] == message.robot;
    });
    if (is_next_hop) return "";
    const std::string& to = message.names[message.to.index()];
    if (message.robot != to)
        return fmt::format("{} was not on the way of the message, which is for {}.", message.robot,
                           to);
    if (!message.dropped) return fmt::format("No robot sent the message to {}.", to);
    const DroppedCopy& last = *message.dropped;
    return fmt::format(
        "No robot sent the message to {}: {} dropped it, because {} ({}), {:.3f} ms after the "
        "message was sent.",
        to, message.names[last.robot.index()], last.why, last.code,
        seconds(last.time - message.sent) * 1e3);
}

}  // namespace

std::string sentence(const MessageAtRobot& message) {
    if (message.is_origin) return message.robot + " is the origin of the message.";
    const FrameList got = with_outcome(message, {Outcome::received, Outcome::duplicate});
    if (!got.empty()) return received_in_words(message, *got.front());
    const FrameList lost = with_outcome(
        message, {Outcome::collided, Outcome::busy, Outcome::garbled, Outcome::not_told});
    if (!lost.empty()) return lost_in_words(message, lost);
    const std::string on_way = unicast_in_words(message);
    if (!on_way.empty()) return on_way;
    if (message.frames.empty()) return "No other robot ever sent the message.";
    const FrameList weak = with_outcome(message, {Outcome::too_weak});
    if (!weak.empty()) return weak_in_words(message, weak);
    const std::string all = counted(message.frames.size(), "frame");
    if (!with_outcome(message, {Outcome::off}).empty()) {
        return fmt::format("{} was switched off, and could receive none of {}.", message.robot,
                           all);
    }
    if (!with_outcome(message, {Outcome::other_network}).empty()) {
        return fmt::format(
            "{} is in a different network than the senders of the message, and could receive none "
            "of {}.",
            message.robot, all);
    }
    return fmt::format("{} {} sent, but to a robot other than {}.", all,
                       message.frames.size() == 1 ? "was" : "were", message.robot);
}

std::string outcome_text(const FrameAtRobot& frame) {
    const bool is_far = frame.outcome == Outcome::too_weak && frame.range;
    return is_far ? "too far" : std::string(name_of(frame.outcome));
}

namespace {

std::string in_lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

Table frame_table(const FrameAtRobot& frame, const MessageAtRobot& message) {
    Array others;
    for (const OverlappingFrame& other : frame.others) {
        const std::string& from = message.names[other.from.index()];
        Table table;
        table.set("from", from);
        table.set("kind", in_lower_case(other.kind));
        const bool has_level = other.has_level && from != message.robot;
        table.set("level_dbm", has_level ? Value(other.level.value) : Value());
        others.emplace_back(std::move(table));
    }
    Table table;
    table.set("from", message.names[frame.from.index()]);
    table.set("after_s", seconds(frame.begin - message.sent));
    table.set("level_dbm", frame.range ? Value() : Value(frame.level.value));
    table.set("margin_db", frame.range ? Value() : Value(frame.margin.value));
    if (frame.range) {
        table.set("distance_m", frame.distance_m);
        table.set("range_m", frame.range->value);
    }
    if (message.tells_walls) {
        table.set("walls", static_cast<std::uint64_t>(frame.walls));
        table.set("wall_m", frame.wall_m);
    }
    table.set("outcome", outcome_text(frame));
    table.set("also_on_air", std::move(others));
    return table;
}

}  // namespace

Table document_of(const MessageAtRobot& message) {
    Array frames;
    for (const FrameAtRobot& frame : message.frames)
        frames.emplace_back(frame_table(frame, message));
    Table table;
    table.set("robot", message.robot);
    table.set("frames", std::move(frames));
    table.set("answer", sentence(message));
    return table;
}

}  // namespace rovernet
