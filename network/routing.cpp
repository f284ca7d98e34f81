// SPDX-License-Identifier: MIT
#include "network/routing.hpp"

#include "network/world.hpp"

#include <stdexcept>
#include <utility>

namespace rovernet {

void Routing::set(Router router) {
    if (router_) throw std::invalid_argument("this network has a routing protocol already");
    router_.emplace(std::move(router));
    world_.on_forgotten = [this](MessageId id) { router_->forget(id); };
}

Time Routing::now() const { return world_.now; }
std::size_t Routing::size() const { return world_.size(); }
const Message& Routing::message(MessageId id) const { return world_.messages[id]; }
bool Routing::is_on(NodeId node) const { return world_.medium.is_on(node); }
std::uint64_t Routing::key(NodeId node) const { return world_.key(node); }
void Routing::hold(MessageId id) { world_.messages.hold(id); }
void Routing::release(MessageId id) { world_.release(id); }

void Routing::broadcast(const Frame& frame, std::optional<NodeId> heard_from) {
    if (receiving_) {
        throw std::invalid_argument("a router may not send while it receives: set a timer");
    }
    mac_.send({frame, heard_from});
}

void Routing::drop(NodeId node, const Frame& frame, DropReason reason) {
    world_.emit(Dropped{world_.now, node, frame, reason});
}

void Routing::timer(NodeId node, Time at, std::uint64_t tag) {
    if (at < world_.now) throw std::invalid_argument("a router set a timer in the past");
    world_.events.schedule(at, Priority::timer, {Occurrence::Kind::router_timer, node, tag});
}

double Routing::draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const {
    return world_.draw(purpose, world_.key(node), world_.messages[id].key, index);
}

void Routing::arrived(const AirFrame& frame, std::span<Reception> receptions, bool undisturbed) {
    if (frame.frame.next_hop == everyone) {
        receive_broadcast(frame, receptions, undisturbed);
    } else {
        receive_unicast(frame, receptions);
    }
}

void Routing::receive_broadcast(const AirFrame& air, std::span<Reception> receptions,
                                bool undisturbed) {
    receiving_ = true;
    if (undisturbed && world_.medium.all_are_on()) {
        hand_up(air.frame, receptions);
    } else {
        hand_up_heard(air.frame, receptions);
    }
    receiving_ = false;
    world_.emit(Received{air.frame, receptions, {}, mac_.header()});
    user_.delivered(air.frame, receptions);
}

/// Hands a broadcast to the router; without one it is for everybody, and goes no further.
void Routing::hand_up(const Frame& frame, std::span<Reception> receptions) {
    if (router_) return router_->on_receive(*this, frame, receptions);
    for (Reception& r : receptions) {
        r.fate = Fate::arrived;
        r.delivered = true;
    }
}

/// Hands up those that got through to nodes that are on; says which are off.
void Routing::hand_up_heard(const Frame& frame, std::span<Reception> receptions) {
    // Together, and picked without a branch: it would be mispredicted for many.
    heard_.resize(receptions.size());
    places_.resize(receptions.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < receptions.size(); ++i) {
        const bool on = world_.medium.is_on(receptions[i].node);
        heard_[count] = receptions[i];
        places_[count] = i;
        count += on & is_decoded(receptions[i].fate);
        if (!on) receptions[i].fate = Fate::off;
    }
    if (count == 0) return;
    hand_up(frame, std::span{heard_}.first(count));
    for (std::size_t k = 0; k < count; ++k) receptions[places_[k]] = heard_[k];
}

/// Hands a frame to the one that it is for; others only overhear it.
void Routing::receive_unicast(const AirFrame& air, std::span<Reception> receptions) {
    for (Reception& r : receptions) {
        if (r.node != air.frame.next_hop) continue;
        if (!world_.medium.is_on(r.node)) {
            r.fate = Fate::off;
        } else if (is_decoded(r.fate)) {
            const bool repeated = mac_.is_repeated(r.node, air);
            r.fate = repeated ? Fate::duplicate : Fate::arrived;
            r.delivered = !repeated;
        }
        world_.emit(Received{air.frame, {&r, 1}, air.reserved, mac_.header()});
        user_.delivered(air.frame, {&r, 1});
    }
}

void Routing::sent(const QueuedFrame& frame) {
    if (router_ && frame.frame.next_hop != everyone) router_->on_sent(*this, frame.frame, true);
    release(frame.frame.message);
    user_.has_room(frame.frame.sender);
}

void Routing::lost(const QueuedFrame& frame, DropReason reason) {
    drop(frame.frame.sender, frame.frame, reason);
    if (router_ && frame.frame.next_hop != everyone) router_->on_sent(*this, frame.frame, false);
    release(frame.frame.message);
    if (reason == DropReason::retries) user_.has_room(frame.frame.sender);
}

}  // namespace rovernet
