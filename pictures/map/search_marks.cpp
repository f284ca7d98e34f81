// SPDX-License-Identifier: MIT
#include "pictures/map/search_marks.hpp"

#include <fmt/format.h>

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
    if (!message.kind.ends_with("REQUEST") || (origin_ && message.origin != *origin_)) return;
    if (senders_.empty() || message.uid > uid_) {
        uid_ = message.uid;
        from_ = message.origin;
        begin_ = sent->time;
        senders_.clear();
    }
    if (message.uid != uid_) return;
    end_ = sent->time;
    senders_.push_back(sent->frame.sender);
}

std::string LastSearch::text(const Network& network) const {
    if (senders_.empty()) {
        return origin_ ? fmt::format("no request of {} so far", network.name(*origin_))
                       : "no request so far";
    }
    if (senders_.size() == 1) {
        return fmt::format("last request of {}: forwarded by no robot, sent at {:.2f} s",
                           network.name(from_), seconds(begin_));
    }
    return fmt::format("last request of {}: sent by {} robots from {:.2f} s to {:.2f} s",
                       network.name(from_), senders_.size(), seconds(begin_), seconds(end_));
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
