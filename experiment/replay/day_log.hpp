// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"
#include "sim/time.hpp"
#include "experiment/replay/deliveries.hpp"
#include "traces/metric_values.hpp"

#include <string>
#include <variant>
#include <vector>

namespace rovernet {

/// What happened when a recorded day was played under some radio.
struct PlayedDay {
    MetricValues metrics;              ///< without the warm-up of the recorded run
    std::vector<Delivery> deliveries;  ///< all of the day, in order
};

/// What robots did on a day, as its trace tells: who moved, spoke and was switched.
struct DayLog {
    /// Message that a robot's application sent.
    struct Said {
        Time time;
        Message message;
    };
    /// Robot that was switched on or off.
    struct Turned {
        Time time;
        NodeId node;
        bool on;
    };

    std::vector<std::vector<Leg>> legs;  ///< by NodeId; empty: it stays where the scenario has it
    std::vector<Said> said;              ///< in order of time
    std::vector<Turned> turned;          ///< in order of time
    PlayedDay recorded;                  ///< what came of it under the radio of the day
    std::vector<std::string> notices;    ///< sentences on what is missing in the trace
};

/// Sink that takes down who moved, spoke and was switched.
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
        // Legs may begin at one time: the later one holds.
        if (!legs.empty() && legs.back().start == moved.leg.start) legs.pop_back();
        legs.push_back(moved.leg);
    }
};

}  // namespace rovernet
