// SPDX-License-Identifier: MIT
#include "experiment/replay/plain_records.hpp"

#include "traces/ns2/ns2_line.hpp"

#include <algorithm>
#include <variant>

namespace rovernet {
namespace {

/// Whether a line can have it as the type of a packet, apart from that of applications' messages.
bool is_plain_kind(std::string_view kind) {
    constexpr std::size_t longest = 64;
    return kind.size() <= longest && kind != "message" &&
           std::all_of(kind.begin(), kind.end(), [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

/// Takes a line's time and robot. @return whether the line can hold them
bool PlainRecords::take(Time time, NodeId node) {
    constexpr Time latest{Duration{9'000'000'000'000'000'000}};
    if (node.value >= most_robots || time < start_of_run || time > latest) return false;
    if (node.index() >= seen_.size()) seen_.resize(node.index() + 1);
    if (!seen_[node.index()]) ++robots_;
    seen_[node.index()] = true;
    return true;
}

bool PlainRecords::takes_message(MessageId id, const RecordContext& context) {
    const std::string_view kind = context.messages[id].protocol();
    if (id.index() >= kinds_.size()) kinds_.resize(id.index() + 1);
    if (kind.empty() || kinds_[id.index()] == kind.data()) return true;
    if (!is_plain_kind(kind)) return false;
    kinds_[id.index()] = kind.data();
    return true;
}

bool PlainRecords::take(const Record& record, const RecordContext& context) {
    if (const auto* received = std::get_if<Received>(&record)) {
        if (!takes_message(received->frame.message, context)) return false;
        for (const Reception& rx : received->receptions) {
            if (!take(rx.time, rx.node)) return false;
        }
        return true;
    }
    if (const auto* sent = std::get_if<Sent>(&record)) {
        // A line of an application has one type.
        return context.messages[sent->message].kind.empty() &&
               sent->reachable.value_or(0) < most_robots && take(sent->time, sent->node);
    }
    if (const auto* t = std::get_if<Transmitted>(&record)) {
        return takes_message(t->frame.message, context) && take(t->time, t->frame.sender);
    }
    if (const auto* dropped = std::get_if<Dropped>(&record)) {
        return takes_message(dropped->frame.message, context) && take(dropped->time, dropped->node);
    }
    if (const auto* moved = std::get_if<Moved>(&record)) return take(moved->time, moved->node);
    if (const auto* sent = std::get_if<AirSent>(&record)) {
        const bool is_data = !sent->air.control;
        return (!is_data || takes_message(sent->air.frame.message, context)) &&
               take(sent->time, sent->air.frame.sender);
    }
    if (const auto* control = std::get_if<ControlReceived>(&record)) {
        return take(control->reception.time, control->reception.node);
    }
    return true;  // it has no line
}

}  // namespace rovernet
