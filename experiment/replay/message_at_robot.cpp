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

/// Why a copy was dropped, in words.
std::string_view words_of(DropReason reason) {
    switch (reason) {
        case DropReason::off:
        case DropReason::end: return "it was switched off";
        case DropReason::queue_full: return "its queue was full";
        case DropReason::retries: return "no acknowledgement came";
        case DropReason::unheard: return "the next hop was out of range";
        case DropReason::cut_off:
        case DropReason::held: return "the run ended";
        case DropReason::no_route: return "it had no route";
        case DropReason::loop: return "the message had been there before";
        case DropReason::broken: return "the route broke";
        case DropReason::buffer_full: return "its buffer of messages without a route was full";
        case DropReason::timeout: return "the message had waited too long for a route";
        case DropReason::salvaged: return "the message had been salvaged too often";
        case DropReason::unresolved: return "the address of the next hop was not found";
        case DropReason::own: break;
    }
    return "its routing protocol did so";
}

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
    void drop(NodeId at, Time time, const LossReason& loss, std::string_view why);
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
        message_.to = trace_.context().messages[sent->message].to;
    } else if (std::holds_alternative<AirSent>(record)) {
        if (!air_.frames().empty()) begin(air_.frames().back());
    } else if (const auto* received = std::get_if<Received>(&record)) {
        if (is_it(received->frame.message)) end(*received);
    } else if (const auto* dropped = std::get_if<Dropped>(&record)) {
        if (is_it(dropped->frame.message) && !dropped->protocol_decides)
            drop(dropped->node, dropped->time, dropped->loss(), words_of(dropped->reason));
    }
}

/// Notes that a copy of a unicast was dropped.
void Account::drop(NodeId at, Time time, const LossReason& loss, std::string_view why) {
    if (message_.to == everyone) return;
    message_.dropped = {at, time, std::string(loss.code), why};
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
                      .next_hop = frame.air.frame.next_hop,
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
        if (reception.fate == Fate::ttl && reception.node != message_.to)
            drop(reception.node, reception.time, reason_of(Fate::ttl), "its TTL was used up");
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

}  // namespace rovernet
