// SPDX-License-Identifier: MIT
#include "experiment/engine.hpp"

#include <algorithm>
#include <stdexcept>

namespace rovernet {

void Engine::route(Router router) {
    if (router_) throw std::invalid_argument("this network has a routing protocol already");
    router_.emplace(std::move(router));
}

void Engine::send(NodeId id, std::string payload, std::uint32_t bytes) {
    if (!router_) throw std::invalid_argument("no routing protocol: call route() before sending");
    if (!medium_.is_on(id)) return;
    Node& origin = node(id);
    const std::uint32_t number = origin.messages_sent++;
    const MessageId message = messages_.add({.origin = id,
                                             .uid = next_uid_++,
                                             .number = number,
                                             .key = combine(origin.key, number),
                                             .size = bytes,
                                             .created = now_,
                                             .payload = std::move(payload)});
    Sent sent{now_, id, message, router_->initial_ttl(), static_cast<std::uint32_t>(size()), {}};
    if (wanted_ & kind_reachable) sent.reachable = medium_.reachable(id, now_, legs_);
    emit(sent);
    router_->send(*this, id, message);
    release(message);
}

void Engine::timer(NodeId id, Time at, std::uint64_t tag) {
    if (at < now_) throw std::invalid_argument("a router set a timer in the past");
    queue_.schedule(at, Priority::timer, {Occurrence::Kind::router_timer, id, tag});
}

void Engine::broadcast(const Frame& frame, std::optional<NodeId> heard_from) {
    if (receiving_) {
        throw std::invalid_argument("a router may not send while it receives: set a timer");
    }
    emit(Transmitted{now_, frame, heard_from});
    const std::size_t slot = flights_.take();
    Flight& flight = flights_[slot];
    flight.frame = frame;
    flight.receptions.clear();
    flight.arrived = 0;
    const Time end = now_ + airtime(medium_.radio(frame.sender), messages_[frame.message].size);
    medium_.receivers(frame.sender, now_, end, legs_, flight.receptions);
    if (medium_.radio(frame.sender).success_rate < 1) garble(flight);
    if (flight.receptions.empty()) {
        flights_.release(slot);
        return;
    }
    messages_.hold(frame.message);
    queue_.schedule(flight.receptions.front().time, Priority::frame_end,
                    {Occurrence::Kind::frame, frame.sender, slot});
}

/// Decides which receivers get the frame with errors, by its sender's success rate.
void Engine::garble(Flight& flight) {
    const Frame& frame = flight.frame;
    const double success = medium_.radio(frame.sender).success_rate;
    for (Reception& r : flight.receptions) {
        const Key draw{settings_.seed,
                       settings_.replication,
                       Purpose::link_success,
                       combine(key(frame.sender), key(r.node)),
                       combine(messages_[frame.message].key, frame.path),
                       frame.hops};
        if (uniform(draw) >= success) r.fate = Fate::garbled;
    }
}

/// Serves the receptions of a transmission by one event: as many as come before anything else can
/// happen, then the event is queued again for the rest, in its old place among equal times.
void Engine::arrive(const Scheduler<Occurrence>::Event& event) {
    Flight& flight = flights_[event.payload.data];
    auto& all = flight.receptions;
    for (auto key = event.key;;) {
        const std::size_t first = flight.arrived;
        // Nothing that a reception sets off happens sooner than least_reaction after it.
        const Time horizon = all[first].time + least_reaction;
        std::size_t last = first + 1;
        while (last < all.size() && all[last].time <= horizon &&
               comes_next(event.key.at(all[last].time))) {
            ++last;
        }
        flight.arrived = last;
        now_ = all[last - 1].time;
        receive(flight, std::span{all}.subspan(first, last - first));
        if (last == all.size()) break;
        key = event.key.at(all[last].time);
        if (!comes_next(key)) {
            queue_.requeue(key, event.payload);
            return;
        }
    }
    const MessageId message = flight.frame.message;
    flights_.release(event.payload.data);
    release(message);
}

void Engine::receive(Flight& flight, std::span<Reception> receptions) {
    receiving_ = true;
    auto next = receptions.begin();
    while (next != receptions.end()) {
        const auto heard = [&](const Reception& r) {
            return medium_.is_on(r.node) && r.fate != Fate::garbled;
        };
        const auto deaf = std::find_if_not(next, receptions.end(), heard);
        if (next != deaf) router_->on_receive(*this, flight.frame, {next, deaf});
        next = std::find_if(deaf, receptions.end(), heard);
        for (auto r = deaf; r != next; ++r) {
            if (!medium_.is_on(r->node)) r->fate = Fate::off;
        }
    }
    receiving_ = false;
    emit(Received{flight.frame, receptions});
    if (has_reactions_) hand_over(flight, receptions);
}

void Engine::hand_over(const Flight& flight, std::span<const Reception> receptions) {
    for (const auto& r : receptions) {
        if (!r.delivered || node(r.node).on_receive.empty()) continue;
        messages_.hold(flight.frame.message);
        const std::uint64_t hops = flight.frame.hops;
        queue_.schedule(
            r.time + least_reaction, Priority::user,
            {Occurrence::Kind::handed_over, r.node, hops << 32 | flight.frame.message.value});
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
