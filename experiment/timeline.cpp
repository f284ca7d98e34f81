// SPDX-License-Identifier: MIT
#include "experiment/timeline.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {

void Timeline::on(const Record& record, const RecordContext& context) {
    std::visit([&](const auto& each) { tell(each, context); }, record);
}

Table& Timeline::add(Time time, NodeId node, std::string_view event, std::string text) {
    Table detail;
    detail.set("t_s", seconds(time));
    detail.set("robot", network_->name(node));
    detail.set("event", event);
    happenings_.push_back({time, node, std::move(text), std::move(detail)});
    return happenings_.back().detail;
}

/// A repeated message is no news: the same words from the same robot.
bool Timeline::is_news(NodeId node, const Message& message) {
    if (known_.size() <= node.index()) known_.resize(node.index() + 1);
    auto& known = known_[node.index()];
    std::pair<NodeId, std::string> words{message.origin, message.payload};
    if (std::find(known.begin(), known.end(), words) != known.end()) return false;
    known.push_back(std::move(words));
    return true;
}

void Timeline::tell(const Sent& sent, const RecordContext& context) {
    const Message& message = context.messages[sent.message];
    if (!is_news(sent.node, message)) return;
    auto& detail = add(sent.time, sent.node, "says", fmt::format("says \"{}\"", message.payload));
    detail.set("payload", message.payload);
}

void Timeline::tell(const Received& received, const RecordContext& context) {
    const Message& message = context.messages[received.frame.message];
    const int hops = received.frame.hops;
    for (const auto& r : received.receptions) {
        if (!r.delivered || !is_news(r.node, message)) continue;
        const auto& from = network_->name(message.origin);
        auto& detail = add(r.time, r.node, "hears",
                           fmt::format("hears \"{}\" from {} over {} hop{}", message.payload, from,
                                       hops, hops == 1 ? "" : "s"));
        detail.set("payload", message.payload);
        detail.set("from", from);
        detail.set("hops", hops);
    }
}

void Timeline::tell(const Arrived& arrived, const RecordContext& context) {
    const Vec3 p = context.legs.position(arrived.node, arrived.time);
    auto& detail = add(arrived.time, arrived.node, "arrives",
                       fmt::format("arrives at ({:.2f}, {:.2f}) m", p.x, p.y));
    detail.set("x_m", p.x);
    detail.set("y_m", p.y);
}

void Timeline::tell(const NoWay& blocked, const RecordContext&) {
    const Vec3 p = blocked.goal;
    auto& detail = add(blocked.time, blocked.node, "finds no way",
                       fmt::format("finds no way to ({:.2f}, {:.2f}) m", p.x, p.y));
    detail.set("x_m", p.x);
    detail.set("y_m", p.y);
}

void Timeline::tell(const Switched& switched, const RecordContext&) {
    add(switched.time, switched.node, switched.on ? "goes on" : "fails",
        switched.on ? "is switched on again" : "is switched off");
}

}  // namespace rovernet
