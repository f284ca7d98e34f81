// SPDX-License-Identifier: MIT
#include "experiment/replay/message_at_robot.hpp"

#include "experiment/replay/recorded_part.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rovernet {
namespace {

Outcome outcome_of(Fate fate) {
    switch (fate) {
        case Fate::waiting:
        case Fate::ttl:
        case Fate::arrived: return Outcome::received;
        case Fate::duplicate: return Outcome::duplicate;
        case Fate::off: return Outcome::off;
        case Fate::garbled: return Outcome::garbled;
        case Fate::collided: return Outcome::collided;
        case Fate::busy: return Outcome::busy;
    }
    return Outcome::not_told;
}

/// Reads a trace for one message at one robot.
class Account {
  public:
    Account(RecordedReader& trace, const std::string& path, const LoadedRun& run, std::uint64_t uid,
            NodeId robot)
        : trace_(trace), air_(run), uid_(uid), robot_(robot) {
        if (robot.index() >= air_.robots()) {
            throw InputError(
                {.source = path},
                fmt::format("found no robot {}; the robots of this trace are 0 to {}", robot.value,
                            static_cast<std::int64_t>(air_.robots()) - 1));
        }
        message_.robot = air_.names()[robot.index()];
        message_.names = air_.names();
        message_.has_walls = !air_.scene().open_field();
    }

    void read_all();
    void read_chunks(const RecordedIndex& index);
    MessageAtRobot result() &&;

  private:
    struct Open {
        std::uint64_t record;
        Arrival arrival;
        FrameAtRobot frame;
    };

    void take(const Record& record);
    void begin(const RecordedFrame& frame);
    void end(const Received& received);
    void meet(Open& open, const RecordedFrame& other) const;
    std::optional<Outcome> outcome_at_begin(const RecordedFrame& frame, Db margin) const;

    RecordedReader& trace_;
    RecordedAir air_;
    std::uint64_t uid_;
    NodeId robot_;
    MessageAtRobot message_;
    std::vector<Open> frames_;  // of the message
};

void Account::read_all() {
    while (const Record* record = trace_.next()) take(*record);
}

void Account::read_chunks(const RecordedIndex& index) {
    read_part(trace_, index, index.chunks_of(uid_), air_,
              [&](const Record& record) { take(record); });
}

void Account::take(const Record& record) {
    air_.take(record, trace_.context());
    const auto is_it = [&](MessageId id) { return trace_.context().messages[id].uid == uid_; };
    if (const auto* sent = std::get_if<Sent>(&record)) {
        if (!is_it(sent->message)) return;
        message_.sent = sent->time;
        message_.is_origin = sent->node == robot_;
    } else if (std::holds_alternative<AirSent>(record)) {
        if (!air_.frames().empty()) begin(air_.frames().back());
    } else if (const auto* received = std::get_if<Received>(&record)) {
        if (is_it(received->frame.message)) end(*received);
    }
}

/// Handles a frame that starts now: a frame of the message, or one that overlaps such a frame.
void Account::begin(const RecordedFrame& frame) {
    const bool is_of_message = !frame.air.control && frame.uid == uid_;
    if (!is_of_message || frame.air.frame.sender == robot_) {
        for (Open& open : frames_) meet(open, frame);
        return;
    }
    const Arrival arrival = air_.arrival(frame, robot_);
    FrameAtRobot here{.from = frame.air.frame.sender,
                      .begin = frame.begin,
                      .end = arrival.end,
                      .level = {arrival.level_dbm},
                      .margin = {},
                      .others = {}};
    here.distance_m = std::sqrt(arrival.squared_distance);
    here.range = range_of(air_.medium().stations().model(here.from));
    here.margin = here.level - air_.medium().stations().radio(robot_).sensitivity;
    for (const Wall& wall : air_.walls(frame, robot_)) {
        ++here.walls;
        here.wall_m += wall.length;
    }
    here.outcome = outcome_at_begin(frame, here.margin).value_or(Outcome::not_told);
    for (Open& open : frames_) meet(open, frame);
    frames_.push_back({frame.record, arrival, std::move(here)});
    for (const RecordedFrame& other : air_.frames()) {
        if (other.record != frame.record) meet(frames_.back(), other);
    }
}

/// Adds another frame to those that overlap, if it does.
void Account::meet(Open& open, const RecordedFrame& other) const {
    if (other.begin > open.arrival.end) return;
    const Arrival arrival = air_.arrival(other, robot_);
    if (!arrival.overlaps(open.arrival)) return;
    if (!arrival.own && !air_.medium().stations().may_link(other.air.frame.sender, robot_)) return;
    const auto range = range_of(air_.medium().stations().model(arrival.from));
    if (!arrival.own && range && arrival.squared_distance > range->value * range->value) return;
    open.frame.others.push_back(
        {arrival.from, other.air.kind(), {arrival.level_dbm}, !range.has_value()});
}

/// Outcome of a frame as far as it is known at its start.
std::optional<Outcome> Account::outcome_at_begin(const RecordedFrame& frame, Db margin) const {
    const NodeId to = frame.air.frame.next_hop;
    if (!air_.medium().stations().is_on(robot_)) return Outcome::off;
    if (!air_.medium().stations().may_link(frame.air.frame.sender, robot_))
        return Outcome::other_network;
    if (margin < Db{0}) return Outcome::too_weak;
    if (to != everyone && to != robot_) return Outcome::for_another;
    return std::nullopt;
}

void Account::end(const Received& received) {
    for (const Reception& reception : received.receptions) {
        if (reception.node != robot_) continue;
        const AirFrame air{.frame = received.frame};
        const RecordedFrame* frame = air_.frame_of(air, uid_, reception);
        for (Open& open : frames_) {
            if (frame && open.record == frame->record) {
                open.frame.outcome = outcome_of(reception.fate);
            }
        }
    }
}

MessageAtRobot Account::result() && {
    for (Open& open : frames_) {
        auto& others = open.frame.others;
        std::stable_sort(others.begin(), others.end(),
                         [](const auto& a, const auto& b) { return a.level > b.level; });
        message_.frames.push_back(std::move(open.frame));
    }
    message_.damage = trace_.damage();
    return std::move(message_);
}

MessageAtRobot read_account(Account account, const RecordedIndex* index) {
    if (index && index->knows_airtimes()) {
        account.read_chunks(*index);
    } else {
        account.read_all();
    }
    return std::move(account).result();
}

}  // namespace

MessageAtRobot message_at_robot(const std::string& path, std::uint64_t uid, NodeId robot,
                                const RecordedIndex* index) {
    RecordedReader trace(path);
    return read_account({trace, path, LoadedRun(trace.run(), path), uid, robot}, index);
}

MessageAtRobot message_at_robot(const std::string& path, const LoadedRun& run, std::uint64_t uid,
                                NodeId robot, const RecordedIndex* index) {
    RecordedReader trace(path);
    return read_account({trace, path, run, uid, robot}, index);
}

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

}  // namespace

std::string sentence(const MessageAtRobot& message) {
    if (message.is_origin) return message.robot + " is the origin of the message.";
    if (message.frames.empty()) return "No other robot ever sent the message.";
    const FrameList got = with_outcome(message, {Outcome::received, Outcome::duplicate});
    if (!got.empty()) return received_in_words(message, *got.front());
    const FrameList lost = with_outcome(
        message, {Outcome::collided, Outcome::busy, Outcome::garbled, Outcome::not_told});
    if (!lost.empty()) return lost_in_words(message, lost);
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
