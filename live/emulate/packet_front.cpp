// SPDX-License-Identifier: MIT
#include "live/emulate/packet_front.hpp"

#include <utility>
#include <vector>

namespace rovernet {

PacketFront::PacketFront(std::unique_ptr<PacketFormat> format, Carrier carrier)
    : format_(std::move(format)), carrier_(std::move(carrier)) {}

void PacketFront::begin(Session& session, const Scenario&) {
    session_ = &session;
    format_->begin(session.network());
    std::vector<NodeId> robots;
    for (NodeId n{0}; n.index() < session.network().size(); ++n.value) robots.push_back(n);
    client_ = session.attach_radios(robots, "programs");
}

std::size_t PacketFront::received(Connection from, std::string_view packet) {
    ++counts_.sent;
    const NodeId robot{from};
    const auto wanted = format_->read(robot, packet);
    if (const auto* fault = std::get_if<PacketFault>(&wanted)) {
        ++(*fault == PacketFault::malformed ? counts_.malformed : counts_.unknown_destination);
        return 1;
    }
    const auto uid =
        session_->carry_out(client_, robot, std::get<SendCommand>(wanted), counts_.sent);
    if (!uid) ++counts_.robot_off;
    session_->step(session_->network().now());  // then the next event is later
    return 1;
}

void PacketFront::tell() {
    for (HeardMessage& heard : session_->heard(client_)) {
        const NodeId at = heard.at;
        const auto packet = format_->write(std::move(heard));
        if (!packet) continue;
        ++counts_.received;
        carrier_.send(at.value, *packet);
    }
}

void PacketFront::report(Table& counts) const {
    counts.set("packets_sent", counts_.sent);
    counts.set("packets_received", counts_.received);
    counts.set("malformed", counts_.malformed);
    counts.set("unknown_destination", counts_.unknown_destination);
    counts.set("robot_off", counts_.robot_off);
}

}  // namespace rovernet
