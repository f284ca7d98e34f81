// SPDX-License-Identifier: MIT
#include "network/engine.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rovernet {

void Engine::route(Router router) {
    if (router_) throw std::invalid_argument("this network has a routing protocol already");
    router_.emplace(std::move(router));
}

MessageId Engine::new_message(NodeId id, NodeId to, std::string payload, Outgoing what) {
    Node& origin = node(id);
    const std::uint32_t number = origin.messages_sent++;
    return messages_.add({.origin = id,
                          .uid = next_uid_++,
                          .number = number,
                          .to = to,
                          .key = combine(key(id), number),
                          .size = what.bytes,
                          .created = now_,
                          .payload = std::move(payload),
                          .flow = what.flow});
}

/// Robots that a chain of links joins to the sender now, of those that a message is for; if a sink
/// asks for it. Sinks that want it only while it is cheap never get it again once it was not.
std::optional<std::uint32_t> Engine::reachable(NodeId from, NodeId to) {
    if (reachability_.searches() > Reachability::cheap_searches + transmissions_) {
        wanted_ &= ~kind_cheap_reachable;
    }
    if (!(wanted_ & (kind_reachable | kind_cheap_reachable))) return std::nullopt;
    if (to != everyone) return reachability_.reaches(medium_, from, to, now_, legs_) ? 1 : 0;
    if (settings_.reference) return medium_.reachable(from, now_, legs_);
    return reachability_.count(medium_, from, now_, legs_);
}

void Engine::send(NodeId id, std::string payload, Outgoing what) {
    if (!router_) throw std::invalid_argument("no routing protocol: call route() before sending");
    if (!medium_.is_on(id)) return;
    const MessageId message = new_message(id, everyone, std::move(payload), what);
    emit(Sent{now_, id, message, router_->initial_ttl(), static_cast<std::uint32_t>(size()),
              reachable(id, everyone)});
    router_->send(*this, id, message);
    release(message);
}

/// The run is over: drops the messages that have arrived nowhere and are still under way.
void Engine::cut_off() {
    messages_.for_each_at_its_origin([this](MessageId id) {
        const Message& m = messages_[id];
        emit(
            Dropped{now_, m.origin,
                    Frame{.message = id, .sender = m.origin, .ttl = 1, .hops = 1, .next_hop = m.to},
                    DropReason::cut_off});
    });
}

void Engine::timer(NodeId id, Time at, std::uint64_t tag) {
    if (at < now_) throw std::invalid_argument("a router set a timer in the past");
    queue_.schedule(at, Priority::timer, {Occurrence::Kind::router_timer, id, tag});
}

void Engine::broadcast(const Frame& frame, std::optional<NodeId> heard_from) {
    if (receiving_) {
        throw std::invalid_argument("a router may not send while it receives: set a timer");
    }
    if (!aloha_ && !dcf_) {
        transmit({.frame = frame, .heard_from = heard_from});
        return;
    }
    messages_.hold(frame.message);
    if (aloha_) return aloha_->send(*this, {frame, heard_from});
    dcf_->send(*this, {frame, heard_from});
}

void Engine::receive(Flight& flight, std::span<Reception> receptions) {
    if (flight.air.kind == AirFrame::data) {
        if (flight.air.frame.next_hop == everyone) {
            receive_broadcast(flight, receptions);
        } else {
            receive_unicast(flight, receptions);
        }
    }
}

/// Hands a broadcast to the router; without one it is for everybody, and goes no further.
void Engine::hand_up(const Flight& flight, std::span<Reception> receptions) {
    if (router_) return router_->on_receive(*this, flight.air.frame, receptions);
    for (Reception& r : receptions) {
        r.fate = Fate::arrived;
        r.delivered = true;
    }
}

void Engine::receive_broadcast(Flight& flight, std::span<Reception> receptions) {
    receiving_ = true;
    if (flight.undisturbed && medium_.all_are_on()) {
        hand_up(flight, receptions);
    } else {
        hand_up_heard(flight, receptions);
    }
    receiving_ = false;
    emit(Received{flight.air.frame, receptions, {}, header()});
    if (has_reactions_) hand_over(flight, receptions);
}

/// Hands up those that got through to nodes that are on; says which are off.
void Engine::hand_up_heard(const Flight& flight, std::span<Reception> receptions) {
    // Together, and picked without a branch: it would be mispredicted for many.
    heard_.resize(receptions.size());
    places_.resize(receptions.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < receptions.size(); ++i) {
        const bool on = medium_.is_on(receptions[i].node);
        heard_[count] = receptions[i];
        places_[count] = i;
        count += on & is_decoded(receptions[i].fate);
        if (!on) receptions[i].fate = Fate::off;
    }
    if (count == 0) return;
    hand_up(flight, std::span{heard_}.first(count));
    for (std::size_t k = 0; k < count; ++k) receptions[places_[k]] = heard_[k];
}

void Engine::hand_over(const Flight& flight, std::span<const Reception> receptions) {
    heard_.clear();
    for (const auto& r : receptions) {
        if (r.delivered && !node(r.node).on_receive.empty()) heard_.push_back(r);
    }
    std::sort(heard_.begin(), heard_.end(), [this](const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : key(a.node) < key(b.node);
    });
    const Frame& frame = flight.air.frame;
    const std::uint64_t hops = frame.hops;
    for (const Reception& r : heard_) {
        messages_.hold(frame.message);
        queue_.schedule(r.time + least_reaction, Priority::user,
                        {Occurrence::Kind::handed_over, r.node, hops << 32 | frame.message.value});
    }
}

/// @param handed_over  the message's id, and above its 32 bits the hops
void Engine::react(NodeId id, std::uint64_t handed_over) {
    const MessageId message{static_cast<std::uint32_t>(handed_over)};
    const Heard how{static_cast<int>(handed_over >> 32)};
    const Message heard = messages_[message];  // a copy: reactions may send
    release(message);
    if (!medium_.is_on(id)) return;
    auto& reactions = node(id).on_receive;
    for (std::size_t i = 0; i < reactions.size(); ++i) {
        const auto reaction = reactions[i];
        (*reaction)(heard, how);
    }
}

}  // namespace rovernet
