// SPDX-License-Identifier: MIT
#include "network/routing.hpp"

#include "network/world.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

/// Frame as its sender received it, before the changes of forwarding.
Frame as_received(const QueuedFrame& sending) {
    Frame frame = sending.frame;
    if (!sending.heard_from) return frame;
    frame.sender = *sending.heard_from;
    ++frame.ttl;
    --frame.hops;
    return frame;
}

SendResult result_of(DropReason reason) {
    switch (reason) {
        case DropReason::queue_full: return SendResult::queue_full;
        case DropReason::retries: return SendResult::retries;
        default: return SendResult::off;
    }
}

}  // namespace

void Routing::set(Router router) {
    if (router_) throw std::invalid_argument("this network has a routing protocol already");
    router_.emplace(std::move(router));
    world_.on_forgotten = [this](MessageId id) { router_->forget(id); };
    if (router_->traits().wants_levels) world_.levels_wanted = true;
}

/// Calls the router, then transmits the frames that it queued meanwhile, so that it is not called
/// back inside its own functions.
template <class Call>
void Routing::call_router(Call call) {
    const bool is_outermost = !std::exchange(calling_, true);
    call();
    if (!is_outermost) return;
    for (std::size_t i = 0; i < outbox_.size(); ++i) {  // results may send more
        const QueuedFrame frame = outbox_[i];
        send_now(frame);
    }
    outbox_.clear();
    calling_ = false;
}

void Routing::originate(NodeId node, MessageId message) {
    call_router([&] { router_->send(*this, node, message); });
}

void Routing::send_one_hop(const Frame& frame) {
    world_.messages.hold(frame.message);
    mac_.send({frame, std::nullopt});
}

void Routing::on_timer(NodeId node, std::uint64_t tag) {
    call_router([&] { router_->on_timer(*this, node, tag); });
}

/// Starts the nodes in the order of their keys, so that their ids have no effect.
void Routing::start() {
    if (!router_ || !router_->hears_of_starts()) return;
    std::vector<NodeId> nodes;
    for (std::uint32_t i = 0; i < world_.size(); ++i) nodes.push_back(NodeId{i});
    std::sort(nodes.begin(), nodes.end(), [this](NodeId a, NodeId b) { return key(a) < key(b); });
    for (const NodeId node : nodes) on_start(node);
}

void Routing::on_start(NodeId node) {
    if (router_) call_router([&] { router_->on_start(*this, node); });
}

void Routing::on_switched(NodeId node, bool on) {
    if (router_) call_router([&] { router_->on_switched(*this, node, on); });
}

Time Routing::now() const { return world_.now; }
std::size_t Routing::size() const { return world_.size(); }
const Message& Routing::message(MessageId id) const { return world_.messages[id]; }
bool Routing::is_on(NodeId node) const { return world_.medium.stations().is_on(node); }
std::uint64_t Routing::key(NodeId node) const { return world_.key(node); }
Vec3 Routing::position(NodeId node) const { return world_.legs.position(node, world_.now); }
void Routing::hold(MessageId id) { world_.messages.hold(id); }
void Routing::release(MessageId id) { world_.release(id); }

MessageId Routing::originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                             std::string content) {
    if (from.index() >= packets_.size()) packets_.resize(from.index() + 1);
    const std::uint32_t number = packets_[from.index()]++;
    constexpr std::uint64_t own = 0x70726f746f636f6c;  // apart from applications' messages
    return world_.new_message({.origin = from,
                               .number = number,
                               .to = to,
                               .key = combine(combine(world_.key(from), own), number),
                               .size = bytes,
                               .payload = std::move(content),
                               .kind = kind,
                               .is_routed = true});
}

std::optional<SendHandle> Routing::send(const Frame& frame, std::optional<NodeId> heard_from,
                                        Time at) {
    if (at < world_.now || (receiving_ && at == world_.now)) {
        throw std::invalid_argument(receiving_
                                        ? "a router may not send while it receives: send 1 us later"
                                        : "a router sent a frame in the past");
    }
    world_.messages.hold(frame.message);
    if (at == world_.now) {
        outbox_.push_back({frame, heard_from});
        return std::nullopt;
    }
    const std::size_t slot = waiting_.take();
    waiting_[slot] = {frame, heard_from};
    world_.events.schedule(at, Priority::timer, {Occurrence::Kind::send, frame.sender, slot});
    return static_cast<SendHandle>(slot);
}

QueuedFrame* Routing::waiting(SendHandle handle) {
    QueuedFrame& frame = waiting_[handle];
    return frame.frame.sender == everyone ? nullptr : &frame;
}

void Routing::cancel(SendHandle handle) {
    QueuedFrame* frame = waiting(handle);
    if (!frame) return;
    frame->frame.sender = everyone;
    world_.release(frame->frame.message);
}

void Routing::on_send(SendHandle handle) {
    const QueuedFrame frame = waiting_[handle];
    waiting_[handle].frame.sender = everyone;
    waiting_.release(handle);
    if (frame.frame.sender == everyone) return;  // taken back
    send_now(frame);
}

/// Sends a frame whose message is held for it.
void Routing::send_now(const QueuedFrame& frame) {
    const NodeId sender = frame.frame.sender;
    if (world_.medium.stations().is_on(sender)) return mac_.send(frame);
    drop(sender, as_received(frame), DropReason::off);
    tell(frame.frame, SendResult::off);
    world_.release(frame.frame.message);
}

std::vector<QueuedFrame> Routing::take_queued(NodeId node, NodeId next_hop) {
    return mac_.take(node, next_hop);
}

void Routing::drop(NodeId node, const Frame& frame, DropReason reason) {
    world_.emit(Dropped{world_.now, node, frame, reason});
}

Dbm Routing::level(const Reception& reception) const {
    return levels_[static_cast<std::size_t>(&reception - handed_up_)];
}

void Routing::timer(NodeId node, Time at, std::uint64_t tag) {
    if (at < world_.now) throw std::invalid_argument("a router set a timer in the past");
    world_.events.schedule(at, Priority::timer, {Occurrence::Kind::router_timer, node, tag});
}

double Routing::draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const {
    return world_.draw(purpose, world_.key(node), world_.messages[id].key, index);
}

double Routing::draw(Purpose purpose, NodeId node, std::uint64_t index) const {
    return world_.draw(purpose, world_.key(node), 0, index);
}

void Routing::frame_ended(const AirFrame& frame, const Arriving& part) {
    if (frame.frame.next_hop == everyone) {
        receive_broadcast(frame, part);
    } else {
        receive_unicast(frame, part);
    }
}

void Routing::receive_broadcast(const AirFrame& air, const Arriving& part) {
    if (part.error_free && world_.medium.stations().all_are_on()) {
        hand_up(air.frame, part.receptions, part.levels);
    } else {
        hand_up_heard(air.frame, part);
    }
    world_.emit(
        Received{air.frame, part.receptions, {}, mac_.header(), world_.for_sinks(part.levels)});
    user_.delivered(air.frame, part.receptions, part.levels);
}

/// Passes a frame to the router; without a router it is for everybody, and is not forwarded.
void Routing::hand_up(const Frame& frame, std::span<Reception> receptions,
                      std::span<const Dbm> levels) {
    if (!router_) {
        for (Reception& r : receptions) {
            r.fate = Fate::arrived;
            r.delivered = true;
        }
        return;
    }
    handed_up_ = receptions.data();
    levels_ = levels;
    receiving_ = true;
    router_->on_receive(*this, frame, receptions);
    receiving_ = false;
    if (world_.messages[frame.message].kind.empty()) return;
    for (Reception& r : receptions) r.delivered = false;  // no application's message
}

/// Passes up receptions that were decoded at nodes that are on; marks the others as off.
void Routing::hand_up_heard(const Frame& frame, const Arriving& part) {
    const std::span<Reception> receptions = part.receptions;
    // Receptions are selected without a branch, which would often be mispredicted.
    heard_.resize(receptions.size());
    heard_levels_.resize(part.levels.size());
    places_.resize(receptions.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < receptions.size(); ++i) {
        const bool on = world_.medium.stations().is_on(receptions[i].node);
        heard_[count] = receptions[i];
        places_[count] = i;
        count += on & is_decoded(receptions[i].fate);
        if (!on) receptions[i].fate = Fate::off;
    }
    if (count == 0) return;
    if (!part.levels.empty()) {
        for (std::size_t k = 0; k < count; ++k) heard_levels_[k] = part.levels[places_[k]];
    }
    hand_up(frame, std::span{heard_}.first(count), heard_levels_);
    for (std::size_t k = 0; k < count; ++k) receptions[places_[k]] = heard_[k];
}

void Routing::receive_unicast(const AirFrame& air, const Arriving& part) {
    const bool overhears = router_ && router_->traits().overhears;
    for (std::size_t i = 0; i < part.receptions.size(); ++i) {
        Reception& r = part.receptions[i];
        const auto level = part.levels.empty() ? part.levels : part.levels.subspan(i, 1);
        if (r.node == air.frame.next_hop) {
            receive_unicast(air, r, level);
        } else if (overhears && is_decoded(r.fate) && world_.medium.stations().is_on(r.node)) {
            Reception overheard = r;
            hand_up(air.frame, {&overheard, 1}, level);
        }
    }
}

/// Passes a unicast frame to its destination.
void Routing::receive_unicast(const AirFrame& air, Reception& r, std::span<const Dbm> level) {
    if (!world_.medium.stations().is_on(r.node)) {
        r.fate = Fate::off;
    } else if (is_decoded(r.fate)) {
        if (mac_.is_repeated(r.node, air)) {
            r.fate = Fate::duplicate;
            r.delivered = false;
        } else if (world_.messages[air.frame.message].is_routed) {
            hand_up(air.frame, {&r, 1}, level);
        } else {
            r.fate = Fate::arrived;
            r.delivered = true;
        }
    }
    world_.emit(Received{air.frame, {&r, 1}, air.reserved, mac_.header(), world_.for_sinks(level)});
    user_.delivered(air.frame, {&r, 1}, level);
}

void Routing::sent(const QueuedFrame& frame) {
    const bool acked = frame.frame.next_hop != everyone && mac_.acknowledges();
    tell(frame.frame, acked ? SendResult::acked : SendResult::sent);
    release(frame.frame.message);
    user_.has_room(frame.frame.sender);
}

void Routing::lost(const QueuedFrame& frame, DropReason reason) {
    drop(frame.frame.sender, frame.frame, reason);
    tell(frame.frame, result_of(reason));
    release(frame.frame.message);
    if (reason == DropReason::retries) user_.has_room(frame.frame.sender);
}

/// Reports the result of a frame to the router.
void Routing::tell(const Frame& frame, SendResult result) {
    if (!router_ || !router_->hears_of_results()) return;
    if (!world_.messages[frame.message].is_routed) return;
    call_router([&] { router_->on_sent(*this, frame, result); });
}

}  // namespace rovernet
