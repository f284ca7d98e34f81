// SPDX-License-Identifier: MIT
#include "experiment/replay/ns2_record.hpp"

#include "experiment/version.hpp"
#include "traces/ns2/ns2_reader.hpp"
#include "traces/recorded/recorded_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <variant>

namespace rovernet {
namespace {

/// Sink that finds the airtime of each transmission.
class Airtimes {
  public:
    KindMask kinds() const { return kind_of<Transmitted>() | kind_of<Received>(); }
    void on(const Record& record, const RecordContext& context) {
        const auto key = [&](const Frame& frame) {
            return std::pair(frame.sender, context.messages[frame.message].uid);
        };
        if (const auto* sent = std::get_if<Transmitted>(&record)) {
            open_[key(sent->frame)] = {sent->time, all.size()};
            all.emplace_back(0);
        } else if (const auto* received = std::get_if<Received>(&record)) {
            const auto open = open_.find(key(received->frame));
            if (open == open_.end()) return;
            all[open->second.number] = received->receptions.front().time - open->second.begin;
            open_.erase(open);
        }
    }

    std::vector<Duration> all;  ///< in the order of transmissions; 0: nobody received it

  private:
    struct Open {
        Time begin;
        std::size_t number;
    };
    std::map<std::pair<NodeId, std::uint64_t>, Open> open_;  // frames that nobody received yet
};

/// Sink that writes the records with the legs between them.
class Writing {
  public:
    Writing(RecordedTrace& to, const std::vector<std::vector<Leg>>& legs,
            std::vector<Duration> airtimes)
        : to_(to), airtimes_(std::move(airtimes)) {
        for (std::uint32_t robot = 0; robot < legs.size(); ++robot) {
            for (const Leg& leg : legs[robot]) moves_.push_back({leg.start, NodeId{robot}, leg});
            legs_.add({});
        }
        std::stable_sort(moves_.begin(), moves_.end(),
                         [](const Moved& a, const Moved& b) { return a.time < b.time; });
    }

    KindMask kinds() const {
        return kind_of<Sent>() | kind_of<Transmitted>() | kind_of<Received>() | kind_of<Dropped>();
    }
    void on(const Record& record, const RecordContext& context) {
        std::visit(
            [&](const auto& r) {
                if constexpr (requires { r.time; }) move_until(r.time);
            },
            record);
        to_.on(record, context);
        if (const auto* received = std::get_if<Received>(&record)) look(*received);
        const auto* sent = std::get_if<Transmitted>(&record);
        if (!sent) return;
        to_.on(AirSent{.time = sent->time,
                       .air = {.frame = sent->frame, .heard_from = sent->heard_from},
                       .bytes = context.messages[sent->frame.message].size,
                       .airtime = airtimes_[sent_++]},
               context);
    }
    void move_until(Time time) {
        const MessageTable no_messages;
        for (; moved_ < moves_.size() && moves_[moved_].time <= time; ++moved_)
            to_.on(moves_[moved_], {legs_, no_messages});
    }
    /// Whether the trace has lost frames, as lines of the MAC.
    bool has_losses() const { return has_losses_; }

  private:
    void look(const Received& received) {
        for (const Reception& each : received.receptions) has_losses_ |= !is_decoded(each.fate);
    }

    RecordedTrace& to_;
    std::vector<Duration> airtimes_;
    std::vector<Moved> moves_;
    Legs legs_;
    std::size_t moved_ = 0, sent_ = 0;
    bool has_losses_ = false;
};

}  // namespace

std::vector<std::string> record_ns2_trace(const std::string& path, const std::string& to,
                                          const Ns2DayOptions& options) {
    const RecordedDay day = read_ns2_day(path, options);
    const auto airtimes = std::make_shared<Airtimes>();
    read_ns2_trace(path, airtimes);
    RecordedTrace trace(to, {.version = code_version(), .scenario = day.run().scenario});
    const std::vector<std::string>& robots = day.robots();
    trace.begin({.scenario = {},
                 .robots = robots.size(),
                 .name = [&](NodeId robot) -> std::string_view { return robots[robot.index()]; },
                 .seed = day.run().seed,
                 .replication = day.run().replication});
    const auto writing = std::make_shared<Writing>(trace, day.legs(), std::move(airtimes->all));
    read_ns2_trace(path, writing);
    writing->move_until(never);
    trace.finish();
    trace.close();
    std::vector<std::string> sentences = day.notices();
    sentences.emplace_back(
        "An ns-2 trace contains no map and no radio: levels, and the reasons why frames are lost, "
        "are computed for ns-2's default radio on an open field.");
    const std::string_view losses =
        writing->has_losses() ? ""
                              : "This trace contains no lost frames: which robots could have heard "
                                "a lost frame is not shown. ";
    sentences.push_back(fmt::format(
        "{}The shown duration of a frame ends at the first reception of the frame, and includes "
        "the time that the frame waits in the queue.",
        losses));
    return sentences;
}

}  // namespace rovernet
