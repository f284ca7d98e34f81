// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/replay/deliveries.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "sim/time.hpp"
#include "traces/metric_values.hpp"

#include <string>
#include <variant>
#include <vector>

namespace rovernet {

/// Outcome of a recorded run ("day"): the recorded outcome, or the outcome of a new simulation of
/// the same movements and messages with other radio models.
struct PlayedDay {
    MetricValues metrics;              ///< metrics without the warm-up of the recorded run
    std::vector<Delivery> deliveries;  ///< all deliveries, in order of time
};

/// Actions of robots in a recorded run: movements, sent messages, and switching on and off.
struct DayLog {
    /// Message sent by a robot's application.
    struct Said {
        Time time;
        Message message;
    };
    /// Reception of a frame: robot `to` received the frame that robot `from` transmitted.
    struct Heard {
        Time time;
        NodeId from, to;
    };
    /// Switching of a robot on (`on` is true) or off.
    struct Turned {
        Time time;
        NodeId node;
        bool on;
    };

    /// Legs (pieces of movement) of each robot, by NodeId; empty if the trace has no legs.
    std::vector<std::vector<Leg>> legs;
    std::vector<Said> said;            ///< messages sent by applications, in order of time
    std::vector<Turned> turned;        ///< switchings of robots on or off, in order of time
    std::vector<Heard> heard;          ///< frame receptions, in order of time; ns-2 traces only
    PlayedDay recorded;                ///< recorded outcome of the run
    std::vector<std::string> notices;  ///< sentences about broken or missing parts of the trace
};

/// Sink that adds robot movements, sent messages and switching of robots to a DayLog.
struct DayLogSink {
    DayLog& log;

    KindMask kinds() const { return kind_of<Moved>() | kind_of<Sent>() | kind_of<Switched>(); }
    void on(const Record& record, const RecordContext& context) {
        if (const auto* moved = std::get_if<Moved>(&record)) {
            take(*moved);
        } else if (const auto* sent = std::get_if<Sent>(&record)) {
            log.said.push_back({sent->time, context.messages[sent->message]});
        } else if (const auto* switched = std::get_if<Switched>(&record)) {
            log.turned.push_back({switched->time, switched->node, switched->on});
        }
    }

  private:
    void take(const Moved& moved) {
        if (moved.node.index() >= log.legs.size()) log.legs.resize(moved.node.index() + 1);
        std::vector<Leg>& legs = log.legs[moved.node.index()];
        // Two records may have legs with the same start. Then the later record replaces the earlier
        // one.
        if (!legs.empty() && legs.back().start == moved.leg.start) legs.pop_back();
        legs.push_back(moved.leg);
    }
};

}  // namespace rovernet
