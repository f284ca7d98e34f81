// SPDX-License-Identifier: MIT
#include "experiment/replay/air_at_robot.hpp"

#include "experiment/replay/recorded_part.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rovernet {
namespace {

using namespace std::chrono_literals;

constexpr Duration window = 1s;

/// Interval of time.
struct Span {
    Time begin, end;
    Duration length() const { return std::max(end - begin, Duration{0}); }
};

/// Length of the union of intervals.
Duration length_of(std::vector<Span> all) {
    std::sort(all.begin(), all.end(),
              [](const Span& a, const Span& b) { return a.begin < b.begin; });
    Duration length{0};
    Time until = start_of_run;
    for (const Span& each : all) {
        length += Span{std::max(each.begin, until), each.end}.length();
        until = std::max(until, each.end);
    }
    return length;
}

/// Reads a trace for the air at one robot.
class Listening {
  public:
    Listening(RecordedReader& trace, const std::string& path, NodeId robot, Time at)
        : trace_(trace), air_(LoadedRun(trace.run(), path)), robot_(robot) {
        if (robot.index() >= air_.robots()) {
            throw InputError(
                {.source = path},
                fmt::format("found no robot {}; the robots of this trace are 0 to {}", robot.value,
                            static_cast<std::int64_t>(air_.robots()) - 1));
        }
        result_.begin = at - std::min(window, at - start_of_run);
        result_.end = at;
        result_.names = air_.names();
    }

    void read_all() {
        while (const Record* record = trace_.next()) take(*record);
    }
    void read_part(const RecordedIndex& index) {
        rovernet::read_part(trace_, index, index.chunks_between(result_.begin, result_.end), air_,
                            [&](const Record& record) { take(record); });
    }
    AirAtRobot result() &&;

  private:
    void take(const Record& record);
    void begin(const RecordedFrame& frame);
    bool senses(const RecordedFrame& frame, const Arrival& arrival) const;

    RecordedReader& trace_;
    RecordedAir air_;
    NodeId robot_;
    AirAtRobot result_;
    std::vector<Span> busy_, sending_;
    std::map<NodeId, Duration> senders_;
};

void Listening::take(const Record& record) {
    air_.take(record, trace_.context());
    const auto* sent = std::get_if<AirSent>(&record);
    if (sent && sent->time <= result_.end && !air_.frames().empty()) begin(air_.frames().back());
}

void Listening::begin(const RecordedFrame& frame) {
    constexpr Duration longest_delay = 10ms;  // light travels 3,000 km
    if (frame.end + longest_delay < result_.begin) return;
    const NodeId from = frame.air.frame.sender;
    const Arrival arrival = air_.arrival(frame, robot_);
    const Span heard{std::max(arrival.begin, result_.begin), std::min(arrival.end, result_.end)};
    if (heard.length() == Duration{0} || !senses(frame, arrival)) return;
    busy_.push_back(heard);
    if (from == robot_) {
        sending_.push_back(heard);
        ++result_.sent;
    } else {
        senders_[from] += heard.length();
        ++result_.heard;
    }
}

/// Whether a frame is strong enough to occupy the air at the robot.
bool Listening::senses(const RecordedFrame& frame, const Arrival& arrival) const {
    const NodeId from = frame.air.frame.sender;
    if (from == robot_) return true;
    const Stations& stations = air_.medium().stations();
    if (!stations.may_link(from, robot_)) return false;
    if (const auto range = range_of(stations.model(from)))
        return arrival.squared_distance <= range->value * range->value;
    const Radio& radio = stations.radio(robot_);
    const Dbm threshold = radio.carrier_sense_threshold.value_or(radio.sensitivity);
    return arrival.level_dbm >= std::min(threshold, radio.sensitivity).value;
}

AirAtRobot Listening::result() && {
    result_.busy = length_of(std::move(busy_));
    result_.sending = length_of(std::move(sending_));
    result_.senders.assign(senders_.begin(), senders_.end());
    std::stable_sort(result_.senders.begin(), result_.senders.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    return std::move(result_);
}

}  // namespace

AirAtRobot air_at_robot(const std::string& path, NodeId robot, Time at,
                        const RecordedIndex* index) {
    RecordedReader trace(path);
    Listening listening(trace, path, robot, at);
    if (index && index->knows_airtimes()) {
        listening.read_part(*index);
    } else {
        listening.read_all();
    }
    return std::move(listening).result();
}

Table document_of(const AirAtRobot& air) {
    constexpr std::size_t most_senders = 5;
    const Duration whole = air.end - air.begin;
    const auto share = [&](Duration part) {
        return whole > Duration{0} ? Value(seconds(part) / seconds(whole)) : Value();
    };
    Array senders;
    for (const auto& [robot, time] : air.senders) {
        if (senders.size() == most_senders) break;
        Table sender;
        sender.set("robot", air.names[robot.index()]);
        sender.set("share", share(time));
        senders.emplace_back(std::move(sender));
    }
    Table table;
    table.set("from_s", seconds(air.begin - start_of_run));
    table.set("to_s", seconds(air.end - start_of_run));
    table.set("busy", share(air.busy));
    table.set("sending", share(air.sending));
    table.set("frames_sent", static_cast<std::uint64_t>(air.sent));
    table.set("frames_heard", static_cast<std::uint64_t>(air.heard));
    table.set("senders", std::move(senders));
    return table;
}

}  // namespace rovernet
