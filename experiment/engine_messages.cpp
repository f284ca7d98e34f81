// SPDX-License-Identifier: MIT
#include "experiment/engine.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rovernet {

void Engine::route(Router router) {
    if (router_) throw std::invalid_argument("this network has a routing protocol already");
    router_.emplace(std::move(router));
}

MessageId Engine::new_message(NodeId id, NodeId to, std::string payload, std::uint32_t bytes) {
    Node& origin = node(id);
    const std::uint32_t number = origin.messages_sent++;
    return messages_.add({.origin = id,
                          .uid = next_uid_++,
                          .number = number,
                          .to = to,
                          .key = combine(origin.key, number),
                          .size = bytes,
                          .created = now_,
                          .payload = std::move(payload)});
}

void Engine::send(NodeId id, std::string payload, std::uint32_t bytes) {
    if (!router_) throw std::invalid_argument("no routing protocol: call route() before sending");
    if (!medium_.is_on(id)) return;
    const MessageId message = new_message(id, everyone, std::move(payload), bytes);
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
    if (!aloha_ && !dcf_) {
        transmit({.frame = frame, .heard_from = heard_from});
        return;
    }
    messages_.hold(frame.message);
    if (aloha_) return aloha_->send(*this, {frame, heard_from});
    dcf_->send(*this, {frame, heard_from});
}

Time Engine::transmit(const AirFrame& air) {
    const Frame& frame = air.frame;
    if (air.kind == AirFrame::data) emit(Transmitted{now_, frame, air.heard_from});
    if (wanted_ & kind_of<AirSent>()) emit(AirSent{now_, air, bytes(air)});
    const std::size_t slot = flights_.take();
    Flight& flight = flights_[slot];
    flight.air = air;
    flight.receptions.clear();
    flight.arrived = 0;
    const Time end = now_ + airtime(air);
    if (dcf_ || !std::holds_alternative<Threshold>(settings_.reception)) {
        flight.number = node(frame.sender).transmissions++;
        fly(slot, end);
    } else {
        medium_.receivers(frame.sender, now_, end, legs_, flight.receptions);
    }
    if (medium_.radio(frame.sender).success_rate < 1) garble(flight);
    if (flight.receptions.empty()) {
        flights_.release(slot);
        return end;
    }
    if (air.kind == AirFrame::data) messages_.hold(frame.message);
    queue_.schedule(flight.receptions.front().time, Priority::frame_end,
                    {Occurrence::Kind::frame, frame.sender, slot});
    return end;
}

/// Makes a frame known to all that sense it, where it may meet others.
void Engine::fly(std::size_t slot, Time end) {
    Flight& flight = flights_[slot];
    const NodeId sender = flight.air.frame.sender;
    const auto tell = [&](const Medium::Hearer& h, std::uint32_t reception) {
        const Time begin = now_ + h.delay, over = end + h.delay;
        if (dcf_ && h.senses) dcf_->energy(h.node, begin, over);
        const double level = std::isnan(h.loss_db)
                                 ? h.loss_db
                                 : medium_.level_after(sender, h.node, h.loss_db).value;
        meet(h.node, {.begin = begin,
                      .end = over,
                      .level_dbm = level,
                      .squared_distance = h.squared_distance,
                      .from = sender,
                      .flight = static_cast<std::uint32_t>(slot),
                      .reception = reception});
    };
    if (std::holds_alternative<Sinr>(settings_.reception)) count_on_air(end);
    meet(sender, own_frame(sender, now_, end));
    const Medium::Hearers hearers = medium_.sensed(sender, now_, legs_);
    for (const Medium::Hearer& h : hearers.receivers) {
        flight.receptions.push_back({.node = h.node, .time = end + h.delay});
        tell(h, static_cast<std::uint32_t>(flight.receptions.size() - 1));
    }
    for (const Medium::Hearer& h : hearers.others) tell(h, Arrival::no_reception);
}

void Engine::count_on_air(Time end) {
    std::erase_if(ends_, [&](Time each) { return each <= now_; });
    ends_.push_back(end);
    most_on_air_ = std::max(most_on_air_, ends_.size());
}

std::optional<Db> Engine::interference_left_out() const {
    if (!std::holds_alternative<Sinr>(settings_.reception)) return std::nullopt;
    // Beside the frame that is received.
    return medium_.left_out(std::max<std::size_t>(most_on_air_, 1) - 1);
}

/// A frame will be on air at `node`, perhaps together with others.
void Engine::meet(NodeId node, const Arrival& arrival) {
    if (const auto* collision = std::get_if<Collision>(&settings_.reception)) {
        disturb(*collision, node, arrival);
    } else if (std::holds_alternative<Sinr>(settings_.reception)) {
        sinr_receivers_.add(on_air_, node, arrival, now_);
    }
}

/// Decides at the rung "sinr" what becomes of receptions that end now.
void Engine::judge(std::size_t slot, std::span<Reception> receptions) {
    Flight& flight = flights_[slot];
    const AirFrame& air = flight.air;
    const NodeId sender = air.frame.sender;
    const BitRate rate = rate_of(air);
    const std::uint64_t attempt = flight.number;
    const Modulation modulation = *modulation_of(rate);
    const Duration payload = airtime(air) - medium_.radio(sender).preamble;
    for (Reception& r : receptions) {
        const auto place = static_cast<std::uint32_t>(&r - flight.receptions.data());
        const SinrFrame frame{.modulation = modulation,
                              .rate = rate.value,
                              .payload = payload,
                              .noise = medium_.noise(r.node)};
        const Fate fate = sinr_receivers_.judge(
            on_air_, r.node, static_cast<std::uint32_t>(slot), place, r.time, frame,
            [&](const Arrival& a) {
                return medium_.level(a.from, r.node, a.squared_distance).value;
            },
            [&] {
                return uniform({settings_.seed, settings_.replication, Purpose::bit_errors,
                                combine(key(sender), key(r.node)), attempt, 0});
            });
        const bool decoded_but_garbled = is_decoded(fate) && r.fate == Fate::garbled;
        if (!decoded_but_garbled) r.fate = fate;
    }
}

/// What an arrival does to the others at `node`, and they to it.
void Engine::disturb(const Collision& rung, NodeId node, const Arrival& arrival) {
    rung.add(
        on_air_, node, arrival, now_,
        [&](const Arrival& a) { return medium_.level(a.from, node, a.squared_distance).value; },
        [&](const Arrival& lost) {
            flights_[lost.flight].receptions[lost.reception].fate =
                lost.collided ? Fate::collided : Fate::busy;
        });
}

/// Decides which receivers get the frame with errors, by its sender's success rate.
void Engine::garble(Flight& flight) {
    if (flight.air.kind != AirFrame::data) return;
    const Frame& frame = flight.air.frame;
    const double success = medium_.radio(frame.sender).success_rate;
    for (Reception& r : flight.receptions) {
        const Key draw{settings_.seed,
                       settings_.replication,
                       Purpose::link_success,
                       combine(key(frame.sender), key(r.node)),
                       combine(messages_[frame.message].key, frame.path),
                       frame.hops + (std::uint64_t{flight.air.attempt} << 16)};
        if (is_decoded(r.fate) && uniform(draw) >= success) r.fate = Fate::garbled;
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
        std::size_t last = all.size();
        if (settings_.reference || all.back().time > horizon ||
            !comes_next(event.key.at(all.back().time))) {
            last = first + 1;
        }
        while (!settings_.reference && last < all.size() && all[last].time <= horizon &&
               comes_next(event.key.at(all[last].time))) {
            ++last;
        }
        flight.arrived = last;
        now_ = all[last - 1].time;
        const auto ended = std::span{all}.subspan(first, last - first);
        if (std::holds_alternative<Sinr>(settings_.reception)) judge(event.payload.data, ended);
        receive(flight, ended);
        if (last == all.size()) break;
        key = event.key.at(all[last].time);
        if (settings_.reference || !comes_next(key)) {
            queue_.requeue(key, event.payload);
            return;
        }
    }
    const AirFrame air = flight.air;
    flights_.release(event.payload.data);
    if (air.kind == AirFrame::data) release(air.frame.message);
}

void Engine::receive(Flight& flight, std::span<Reception> receptions) {
    if (flight.air.kind == AirFrame::data) {
        if (flight.air.frame.next_hop == everyone) {
            receive_broadcast(flight, receptions);
        } else {
            receive_unicast(flight, receptions);
        }
    }
    if (dcf_) tell_stations(flight, receptions);
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
    auto next = receptions.begin();
    while (next != receptions.end()) {
        const auto heard = [&](const Reception& r) {
            return is_decoded(r.fate) && medium_.is_on(r.node);
        };
        const auto deaf = std::find_if_not(next, receptions.end(), heard);
        if (next != deaf) hand_up(flight, {next, deaf});
        next = std::find_if(deaf, receptions.end(), heard);
        for (auto r = deaf; r != next; ++r) {
            if (!medium_.is_on(r->node)) r->fate = Fate::off;
        }
    }
    receiving_ = false;
    emit(Received{flight.air.frame, receptions});
    if (has_reactions_) hand_over(flight, receptions);
}

void Engine::hand_over(const Flight& flight, std::span<const Reception> receptions) {
    for (const auto& r : receptions) {
        if (!r.delivered || node(r.node).on_receive.empty()) continue;
        const Frame& frame = flight.air.frame;
        messages_.hold(frame.message);
        const std::uint64_t hops = frame.hops;
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
