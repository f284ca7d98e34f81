// SPDX-License-Identifier: MIT
#include "network/applications.hpp"

#include "network/world.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rovernet {

MessageId Applications::new_message(NodeId id, NodeId to, std::string payload, Outgoing what,
                                    bool is_routed) {
    has_sent_ = true;
    if (id.index() >= messages_sent_.size()) messages_sent_.resize(id.index() + 1);
    const std::uint32_t number = messages_sent_[id.index()]++;
    return world_.new_message({.origin = id,
                               .number = number,
                               .to = to,
                               .key = combine(world_.key(id), number),
                               .size = what.bytes,
                               .payload = std::move(payload),
                               .flow = what.flow,
                               .is_routed = is_routed});
}

/// Number of a message's destinations that a chain of links connects to the sender now, if a sink
/// requests it. Once the search has become expensive, kind_cheap_reachable is stopped for the run.
std::optional<std::uint32_t> Applications::reachable(NodeId from, NodeId to) {
    World& w = world_;
    if (reachability_.searches() > Reachability::cheap_searches + w.transmissions) {
        w.records.stop(kind_cheap_reachable);
    }
    if (!w.records.wants(kind_reachable | kind_cheap_reachable)) return std::nullopt;
    if (to != everyone) return reachability_.reaches(w.medium, from, to, w.now, w.legs) ? 1 : 0;
    if (w.settings.reference) return Reachability::count_anew(w.medium, from, w.now, w.legs);
    return reachability_.count(w.medium, from, w.now, w.legs);
}

/// Checks the destination of a message. @throws std::invalid_argument unless it is another robot
void Applications::check_destination(NodeId from, NodeId to) const {
    if (to != everyone && (to.index() >= world_.size() || to == from)) {
        throw std::invalid_argument("a unicast needs another robot to go to");
    }
}

void Applications::send(NodeId id, NodeId to, std::string payload, Outgoing what) {
    const auto& router = routing_.router();
    if (!router) throw std::invalid_argument("no routing protocol: call route() before sending");
    check_destination(id, to);
    if (to != everyone && !router->traits().routes_unicasts) {
        throw std::invalid_argument("the routing protocol brings messages to everyone only");
    }
    if (!world_.medium.stations().is_on(id)) return;
    const MessageId message = new_message(id, to, std::move(payload), what, true);
    const auto robots = static_cast<std::uint32_t>(to == everyone ? world_.size() : 2);
    world_.emit(Sent{world_.now, id, message, router->initial_ttl(world_.messages[message]), robots,
                     reachable(id, to)});
    routing_.originate(id, message);
    world_.release(message);
}

void Applications::send_one_hop(NodeId id, NodeId to, std::string payload, Outgoing what) {
    check_destination(id, to);
    if (!world_.medium.stations().is_on(id)) return;
    const MessageId message = new_message(id, to, std::move(payload), what, false);
    const auto robots = static_cast<std::uint32_t>(to == everyone ? world_.size() : 2);
    world_.emit(Sent{world_.now, id, message, 1, robots, reachable(id, to)});
    routing_.send_one_hop({.message = message,
                           .sender = id,
                           .path = world_.key(id),
                           .ttl = 1,
                           .hops = 1,
                           .next_hop = to});
    world_.release(message);
}

void Applications::saturate(NodeId id, NodeId to, Outgoing what) {
    if (!mac_.queues()) {
        throw std::invalid_argument("saturated traffic needs an access model: aloha or csma");
    }
    saturated_[id] = {to, what};
    for (int waiting = 0; waiting < 2; ++waiting) send_one_hop(id, to, {}, what);
}

/// Sends the next frame of a node with saturated traffic, 1 us after the last one.
void Applications::has_room(NodeId id) {
    if (saturated_.empty()) return;
    const auto found = saturated_.find(id);
    if (found == saturated_.end()) return;
    world_.schedule(world_.now + least_reaction, Callback<>([this, id, traffic = found->second] {
                        send_one_hop(id, traffic.to, {}, traffic.what);
                    }));
}

void Applications::on_receive(NodeId id, Callback<const Message&, const Heard&> react) {
    if (id.index() >= on_receive_.size()) on_receive_.resize(id.index() + 1);
    on_receive_[id.index()].push_back(std::move(react));
}

void Applications::delivered(const Frame& frame, std::span<const Reception> receptions) {
    if (on_receive_.empty()) return;
    reacting_.clear();
    for (const auto& r : receptions) {
        if (r.delivered && reacts(r.node)) reacting_.push_back(r);
    }
    std::sort(reacting_.begin(), reacting_.end(), [this](const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : world_.key(a.node) < world_.key(b.node);
    });
    const std::uint64_t hops = frame.hops;
    for (const Reception& r : reacting_) {
        world_.messages.hold(frame.message);
        world_.events.schedule(
            r.time + least_reaction, Priority::user,
            {Occurrence::Kind::handed_over, r.node, hops << 32 | frame.message.value});
    }
}

void Applications::react(NodeId id, std::uint64_t handed_over) {
    const MessageId message{static_cast<std::uint32_t>(handed_over)};
    const Heard how{static_cast<int>(handed_over >> 32)};
    const Message heard = world_.messages[message];  // a copy: reactions may send
    world_.release(message);
    if (!world_.medium.stations().is_on(id)) return;
    // The list is read again in each step, because a reaction may add callbacks.
    for (std::size_t i = 0; i < on_receive_[id.index()].size(); ++i) {
        const auto reaction = on_receive_[id.index()][i];
        reaction(heard, how);
    }
    on_receive_[id.index()].erase_if([](const auto& each) { return each.has_ended(); });
}

/// Drops the messages of which no frame has ended, at the end of the run.
void Applications::cut_off() {
    world_.messages.for_each_at_its_origin([this](MessageId id) {
        const Message& m = world_.messages[id];
        const Frame frame{.message = id, .sender = m.origin, .ttl = 1, .hops = 1, .next_hop = m.to};
        world_.emit(Dropped{world_.now, m.origin, frame, DropReason::cut_off});
    });
}

}  // namespace rovernet
