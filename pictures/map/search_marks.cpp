// SPDX-License-Identifier: MIT
#include "pictures/map/search_marks.hpp"

#include "routing/aodv/aodv_packets.hpp"
#include "routing/dsr/dsr_packets.hpp"

#include <fmt/format.h>

#include <variant>

namespace rovernet {
namespace {

constexpr Color ring_color{0x00, 0x9e, 0x73};
constexpr double ring_width = 4, ring_stroke = 2;  // [px] beyond the robot's circle

void draw_ring(Svg& svg, PicturePoint at, double radius) {
    svg.add("circle", {{"cx", at.x},
                       {"cy", at.y},
                       {"r", radius},
                       {"fill", ring_color},
                       {"fill-opacity", 0.25},
                       {"stroke", ring_color},
                       {"stroke-width", ring_stroke}});
}

}  // namespace

void LastSearch::on(const Record& record, const RecordContext& context) {
    const auto* sent = std::get_if<Transmitted>(&record);
    if (!sent) return;
    const Message& message = context.messages[sent->frame.message];
    if (!message.kind.ends_with("REQUEST")) return;
    const NodeId sender = sent->frame.sender;
    const Request request = request_of(message);
    if (!sent->heard_from && (!origin_ || sender == *origin_)) {
        last_ = request;
        begin_ = sent->time;
        senders_.clear();
    }
    if (request != last_) return;
    end_ = sent->time;
    senders_.push_back(sender);
}

LastSearch::Request LastSearch::request_of(const Message& message) {
    if (message.kind == aodv::request_kind) {
        const aodv::Packet packet = aodv::packet_of(message.payload);
        if (const auto* request = std::get_if<aodv::Request>(&packet))
            return {request->originator, request->id};
    } else if (message.kind == dsr::request_kind) {
        if (const auto request = dsr::packet_of(message).request)
            return {request->path.front(), request->id};
    }
    return {everyone, message.uid};
}

std::string LastSearch::text(const Network& network) const {
    if (senders_.empty()) {
        return origin_ ? fmt::format("no route request of {} so far", network.name(*origin_))
                       : "no route request so far";
    }
    if (senders_.size() == 1) {
        return fmt::format("last route request of {}: forwarded by no robot, sent at {:.2f} s",
                           network.name(senders_.front()), seconds(begin_));
    }
    return fmt::format("last route request of {}: sent by {} robots from {:.2f} s to {:.2f} s",
                       network.name(senders_.front()), senders_.size(), seconds(begin_),
                       seconds(end_));
}

void add_rings(RobotMarks& robots, const LastSearch& search) {
    for (const NodeId node : search.senders()) robots.add_ring(node, ring_width + ring_stroke / 2);
}

void draw_search(Svg& svg, const LastSearch& search, const RobotMarks& robots) {
    svg.open("g", {{"class", "search"}});
    for (const NodeId node : search.senders()) {
        const RobotMark& robot = robots[node];
        if (robot.drawn()) draw_ring(svg, robot.at, robot.radius + ring_width);
    }
    svg.close();
}

void append_search(Legend& legend) {
    legend.add({"sent the last request", 22, [](Svg& svg, PicturePoint p) {
                    draw_ring(svg, {p.x + 11, p.y}, 9);
                }});
}

}  // namespace rovernet
