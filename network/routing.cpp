// SPDX-License-Identifier: MIT
#include "network/routing.hpp"

#include "network/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

SendResult result_of(DropReason reason) {
    switch (reason) {
        case DropReason::queue_full: return SendResult::queue_full;
        case DropReason::retries:
        case DropReason::unheard: return SendResult::retries;
        default: return SendResult::off;
    }
}

/// Name of a message in errors.
[[maybe_unused]] std::string name_of(const Message& message) {
    return fmt::format("message {} ({})", message.uid,
                       message.kind.empty() ? "of an application" : message.kind);
}

}  // namespace

Routing::Routing(World& world, Mac& mac, RoutingUser& user)
    : world_(world), mac_(mac), user_(user) {
    check_fields(world.settings.arp, "access");
    if (world.settings.arp.arp) arp_.emplace(world, *this, world.settings.arp);
}

void Routing::set(Router router) {
    if (router_)
        throw std::invalid_argument(
            "this network already has a routing protocol; call route() only once");
    router_.emplace(std::move(router));
    world_.router = &*router_;
    world_.on_forgotten = [this](MessageId id) { router_->forget(id); };
    world_.on_header_forgotten = [this](std::uint32_t header) { router_->forget_header(header); };
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
    world_.hold(frame);
    pass_down({frame});
}

void Routing::pass_down(const QueuedFrame& frame) {
    if (arp_ && frame.frame.next_hop != everyone && !arp_->admits(frame)) return;
    mac_.send(frame);
}

void Routing::on_arp(NodeId node, NodeId neighbour) { arp_->on_timer(node, neighbour); }

void Routing::on_timer(NodeId node, std::uint64_t tag) {
    call_router([&] { router_->on_timer(*this, node, tag); });
}

void Routing::set_role(NodeId node, std::string role) {
    if (role.empty()) return;
    if (node.index() >= roles_.size()) roles_.resize(node.index() + 1);
    roles_[node.index()] = std::move(role);
}

void Routing::check_role(NodeId node) const {
    const std::string_view mine = role(node);
    if (mine.empty()) return;
    const auto known = router_ ? router_->traits().roles : std::span<const std::string_view>{};
    if (std::find(known.begin(), known.end(), mine) != known.end()) return;
    throw std::invalid_argument(
        known.empty()
            ? fmt::format(
                  "role \"{}\": the routing protocol has no roles; expected a robot without a role",
                  mine)
            : fmt::format(
                  "role \"{}\": the routing protocol has no such role; expected one of \"{}\"",
                  mine, fmt::join(known, "\", \"")));
}

/// Starts the nodes in the order of their keys, so that their ids have no effect.
void Routing::start() {
    for (std::uint32_t i = 0; i < roles_.size(); ++i) check_role(NodeId{i});
    if (!router_ || !router_->hears_of_starts()) return;
    std::vector<NodeId> nodes;
    for (std::uint32_t i = 0; i < world_.size(); ++i) nodes.push_back(NodeId{i});
    std::sort(nodes.begin(), nodes.end(), [this](NodeId a, NodeId b) { return key(a) < key(b); });
    for (const NodeId node : nodes) on_start(node);
}

void Routing::on_start(NodeId node) {
    check_role(node);
    if (router_) call_router([&] { router_->on_start(*this, node); });
}

void Routing::on_switched(NodeId node, bool on) {
    if (arp_ && !on) {
        for (const QueuedFrame& each : arp_->switch_off(node)) lost(each, DropReason::end);
    }
    if (router_) call_router([&] { router_->on_switched(*this, node, on); });
}

Time Routing::now() const { return world_.now; }
std::size_t Routing::size() const { return world_.size(); }
const Message& Routing::message(MessageId id) const { return world_.messages[id]; }
bool Routing::is_on(NodeId node) const { return world_.medium.stations().is_on(node); }
std::uint64_t Routing::key(NodeId node) const { return world_.key(node); }
void Routing::prefetch(NodeId node) const { world_.medium.stations().prefetch(node); }
Vec3 Routing::position(NodeId node) const { return world_.legs.position(node, world_.now); }
std::string_view Routing::role(NodeId node) const {
    return node.index() < roles_.size() ? roles_[node.index()] : std::string_view{};
}
void Routing::hold(MessageId id) {
    count_holds(id, 1);
    world_.messages.hold(id);
}
void Routing::release(MessageId id) {
    count_holds(id, -1);
    world_.release(id);
}
void Routing::hold(const Frame& frame) {
    count_holds(frame.message, 1);
    world_.hold(frame);
}
void Routing::release(const Frame& frame) {
    count_holds(frame.message, -1);
    world_.release(frame);
}

MessageId Routing::originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                             std::string content) {
    if (from.index() >= packets_.size()) packets_.resize(from.index() + 1);
    const std::uint32_t number = packets_[from.index()]++;
    constexpr std::uint64_t own = 0x70726f746f636f6c;  // apart from applications' messages
    const MessageId id = world_.new_message({.origin = from,
                                             .number = number,
                                             .to = to,
                                             .key = combine(combine(world_.key(from), own), number),
                                             .size = bytes,
                                             .payload = std::move(content),
                                             .kind = kind,
                                             .is_routed = true});
    count_holds(id, 1);
    return id;
}

std::optional<SendHandle> Routing::send(const Frame& frame, std::optional<NodeId> heard_from,
                                        Time at) {
    if (at < world_.now || (receiving_ && at == world_.now)) {
        throw std::invalid_argument(
            receiving_ ? "the routing protocol may not send a frame while it handles a reception: "
                         "send the frame 1 us later"
                       : "the routing protocol sent a frame at a time in the past; expected the "
                         "present time or a later time");
    }
    world_.hold(frame);
    world_.messages.note_sending(frame);
    const bool is_control =
        mac_.has_priority() && world_.messages[frame.message].is_routing_packet();
    if (at == world_.now) {
        outbox_.push_back({frame, heard_from, is_control});
        return std::nullopt;
    }
    const std::size_t slot = waiting_.take();
    waiting_[slot] = {frame, heard_from, is_control};
    world_.events.schedule(at, Priority::timer, {Occurrence::Kind::send, frame.sender, slot});
    return static_cast<SendHandle>(slot);
}

Duration Routing::spacing(const Frame& frame) const {
    return mac_.queues() ? Duration{0} : 4 * mac_.airtime({.frame = frame});
}

QueuedFrame* Routing::waiting(SendHandle handle) {
    QueuedFrame& frame = waiting_[handle];
    return frame.frame.sender == everyone ? nullptr : &frame;
}

void Routing::cancel(SendHandle handle) {
    QueuedFrame* frame = waiting(handle);
    if (!frame) return;
    frame->frame.sender = everyone;
    world_.release(frame->frame);
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
    if (!world_.medium.stations().is_on(sender)) {
        drop_sending(sender, frame.as_received(), frame.frame, DropReason::off);
        if (wants_result(frame.frame)) tell(frame, SendResult::off);
        world_.release(frame.frame);
        return;
    }
    if (frame.frame.next_hop != everyone && world_.records.wants<Routed>()) {
        world_.emit(Routed{world_.now, frame.frame, frame.heard_from});
    }
    pass_down(frame);
}

std::vector<QueuedFrame> Routing::take_queued(NodeId node, NodeId next_hop) {
    const auto is_taken = [&](const Frame& frame) {
        return frame.next_hop == next_hop && world_.messages[frame.message].is_routed;
    };
    auto taken = mac_.take(node, is_taken);
    if (arp_) {
        if (const auto held = arp_->take(node, next_hop, is_taken)) taken.push_back(*held);
    }
    for (const QueuedFrame& each : taken) count_holds(each.frame.message, 1);
    return taken;
}

void Routing::drop(NodeId node, const Frame& frame, DropReason reason, std::string_view own_code) {
    const Dropped dropped{world_.now, node, frame, reason, own_code};
    if (!receiving_) return world_.emit(dropped);
    world_.hold(frame);
    drops_.push_back(dropped);
}

void Routing::drop_sending(NodeId node, const Frame& frame, const Frame& sending,
                           DropReason reason) {
    world_.emit(Dropped{world_.now, node, frame, reason, {}, wants_result(sending)});
}

Dbm Routing::level(const Reception& reception) const {
    return levels_[static_cast<std::size_t>(&reception - handed_up_)];
}

void Routing::timer(NodeId node, Time at, std::uint64_t tag) {
    if (at < world_.now)
        throw std::invalid_argument(
            "the routing protocol set a timer to a time in the past; expected the present time or "
            "a later time");
    world_.events.schedule(at, Priority::timer, {Occurrence::Kind::router_timer, node, tag});
}

Db Routing::snr(const Reception& reception) const {
    return level(reception) - world_.medium.stations().noise(reception.node);
}

double Routing::draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const {
    return world_.draw(purpose, world_.key(node), world_.messages[id].key, index);
}

double Routing::draw(Purpose purpose, NodeId node, std::uint64_t index) const {
    return world_.draw(purpose, world_.key(node), 0, index);
}

void Routing::sent(const QueuedFrame& frame, bool acked) {
    if (wants_result(frame.frame)) tell(frame, acked ? SendResult::acked : SendResult::sent);
    end(frame.frame, is_on(frame.frame.sender));
}

void Routing::lost(const QueuedFrame& frame, DropReason reason) {
    lose(frame, reason, result_of(reason));
}

void Routing::unresolved(const QueuedFrame& frame, bool is_displaced) {
    lose(frame, DropReason::unresolved, is_displaced ? SendResult::displaced : SendResult::retries);
}

void Routing::lose(const QueuedFrame& frame, DropReason reason, SendResult result) {
    drop_sending(frame.frame.sender, frame.frame, frame.frame, reason);
    if (wants_result(frame.frame)) tell(frame, result);
    end(frame.frame, result == SendResult::retries);
}

/// Reports a frame that has left the queue of its sender to the application, and releases it.
void Routing::end(const Frame& frame, bool has_room) {
    const Message& message = world_.messages[frame.message];
    if (message.kind.empty()) user_.left_queue(frame.sender, message, has_room);
    world_.release(frame);
}

bool Routing::wants_result(const Frame& frame) const {
    return router_ && router_->hears_of_results() && world_.messages[frame.message].is_routed;
}

/// Reports the result of a frame to the router.
void Routing::tell(const QueuedFrame& frame, SendResult result) {
    call_router([&] { router_->on_sent(*this, frame, result); });
}

/// Counts the router's own references, so that one too few is found at once, and one too many at
/// the end of the run.
void Routing::count_holds([[maybe_unused]] MessageId id, [[maybe_unused]] int change) {
#ifndef NDEBUG
    if (id.index() >= held_.size()) held_.resize(id.index() + 1);
    held_[id.index()] += change;
    if (held_[id.index()] >= 0) return;
    throw std::logic_error(
        fmt::format("the routing protocol released {}, to which this protocol holds no reference",
                    name_of(world_.messages[id])));
#endif
}

void Routing::check_held() const {
#ifndef NDEBUG
    for (MessageId id{0}; id.index() < held_.size(); ++id.value) {
        if (held_[id.index()] == 0 || router_->keeps(id)) continue;
        throw std::logic_error(
            fmt::format("the routing protocol still holds {} reference(s) to {}, but keeps() of "
                        "this protocol returns false for this message",
                        held_[id.index()], name_of(world_.messages[id])));
    }
#endif
}

}  // namespace rovernet
