// SPDX-License-Identifier: MIT
#include "network/engine.hpp"

#include <algorithm>
#include <stdexcept>

namespace rovernet {

std::uint32_t Engine::bytes(const AirFrame& frame) const {
    switch (frame.kind) {
        case AirFrame::rts: return rts_bytes;
        case AirFrame::cts: return cts_bytes;
        case AirFrame::ack: return ack_bytes;
        case AirFrame::data: break;
    }
    return messages_[frame.frame.message].size + header();
}

BitRate Engine::rate_of(const AirFrame& frame) const {
    const NodeId to = frame.frame.next_hop;
    if (!dcf_ || (frame.kind == AirFrame::data && to != everyone)) {
        return medium_.radio(frame.frame.sender).rate;
    }
    if (frame.kind != AirFrame::ack) return dcf_->lowest_basic_rate();  // a CTS answers an RTS
    if (to == everyone) return dcf_->settings().timing.lowest_rate;
    return dcf_->answer_rate(medium_.radio(to).rate);
}

Duration Engine::airtime(const AirFrame& frame) const {
    const Radio& radio = medium_.radio(frame.frame.sender);
    if (!dcf_) return rovernet::airtime(radio, bytes(frame));
    return wifi_airtime(dcf_->settings().standard, radio.preamble, rate_of(frame), bytes(frame));
}

void Engine::access_timer(NodeId node, Time at, std::uint32_t tag) {
    queue_.schedule(at, Priority::timer, {Occurrence::Kind::access_timer, node, tag});
}

double Engine::access_draw(NodeId node, std::uint64_t index) const {
    return uniform({settings_.seed, settings_.replication, Purpose::backoff, key(node), 0, index});
}

void Engine::on_access_timer(NodeId node, std::uint32_t tag) {
    if (aloha_) return aloha_->on_timer(*this, node);
    dcf_->on_timer(*this, node, tag);
}

/// What the stations hear of a frame beside its message: its end, and what it reserves.
void Engine::tell_stations(const Flight& flight, std::span<const Reception> receptions) {
    const AirFrame air = flight.air;
    if ((wanted_ & kind_of<ControlReceived>()) && air.kind != AirFrame::data) {
        for (const Reception& r : receptions) {
            if (r.node != air.frame.next_hop || !medium_.is_on(r.node)) continue;
            emit(ControlReceived{air, r, bytes(air)});
        }
    }
    for (const Reception& r : receptions) {
        now_ = r.time;
        if (!medium_.is_on(r.node)) continue;
        if (is_decoded(r.fate)) {
            dcf_->received(*this, r.node, air);
        } else {
            dcf_->missed(*this, r.node);
        }
    }
}

/// Tells of a unicast whose destination cannot hear it, where no missing acknowledgement does.
void Engine::tell_if_unheard(const Flight& flight) {
    const auto all = flight.receivers.all();
    const Frame& frame = flight.air.frame;
    const auto is_it = [&](const Reception& r) { return r.node == frame.next_hop; };
    if (dcf_ || std::any_of(all.begin(), all.end(), is_it)) return;
    emit(Dropped{now_, frame.sender, frame, DropReason::unheard});
}

/// Hands a frame to the one that it is for; others only overhear it.
void Engine::receive_unicast(Flight& flight, std::span<Reception> receptions) {
    for (Reception& r : receptions) {
        if (r.node != flight.air.frame.next_hop) continue;
        if (!medium_.is_on(r.node)) {
            r.fate = Fate::off;
        } else if (is_decoded(r.fate)) {
            const bool repeated = dcf_ && dcf_->is_repeated(r.node, flight.air);
            r.fate = repeated ? Fate::duplicate : Fate::arrived;
            r.delivered = !repeated;
        }
        emit(Received{flight.air.frame, {&r, 1}, flight.air.reserved, header()});
        if (has_reactions_) hand_over(flight, {&r, 1});
    }
}

void Engine::send_to(NodeId id, NodeId to, std::string payload, Outgoing what) {
    if (to != everyone && (to.index() >= size() || to == id)) {
        throw std::invalid_argument("a unicast needs another robot to go to");
    }
    if (!medium_.is_on(id)) return;
    const MessageId message = new_message(id, to, std::move(payload), what);
    const auto robots = static_cast<std::uint32_t>(to == everyone ? size() : 2);
    emit(Sent{now_, id, message, 1, robots, reachable(id, to)});
    broadcast(
        {.message = message, .sender = id, .path = key(id), .ttl = 1, .hops = 1, .next_hop = to},
        std::nullopt);
    release(message);
}

void Engine::saturate(NodeId id, NodeId to, Outgoing what) {
    if (!aloha_ && !dcf_) {
        throw std::invalid_argument("saturated traffic needs an access model: aloha or csma");
    }
    saturated_[id] = {to, what};
    for (int waiting = 0; waiting < 2; ++waiting) send_to(id, to, {}, what);
}

/// A saturated node has sent a frame: here is the next.
void Engine::refill(NodeId id) {
    const auto found = saturated_.find(id);
    if (found == saturated_.end()) return;
    auto next = std::make_shared<std::function<void()>>(
        [this, id, traffic = found->second] { send_to(id, traffic.to, {}, traffic.what); });
    schedule(now_ + least_reaction, {std::move(next)});
}

void Engine::sent(const QueuedFrame& frame) {
    if (router_ && frame.frame.next_hop != everyone) router_->on_sent(*this, frame.frame, true);
    release(frame.frame.message);
    refill(frame.frame.sender);
}

void Engine::lost(const QueuedFrame& frame, DropReason reason) {
    emit(Dropped{now_, frame.frame.sender, frame.frame, reason});
    if (router_ && frame.frame.next_hop != everyone) router_->on_sent(*this, frame.frame, false);
    release(frame.frame.message);
    if (reason == DropReason::retries) refill(frame.frame.sender);
}

}  // namespace rovernet
