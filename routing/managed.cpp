// SPDX-License-Identifier: MIT
#include "routing/managed_router.hpp"
#include "routing/relay.hpp"

#include <algorithm>

namespace rovernet {

Managed::operator Router() const { return ManagedRouter{*this}; }

namespace {

constexpr int smallest_window = 3, largest_window = 8;
/// Slots in which only routers relay (M2).
constexpr int router_slots = 2 * largest_window;

/// Whether the source itself sent a copy: its hop limit is the first one.
bool is_from_source(const Frame& frame) { return frame.hops == 1; }

}  // namespace

ManagedRouter::ManagedRouter(const Managed& managed) : settings_(managed) {
    check_fields(managed, "managed");
}

int ManagedRouter::contention_window(Db snr) {
    constexpr int low = -20, high = 10;
    const double clamped = snr.value > low ? std::min<double>(snr.value, high) : low;
    return smallest_window +
           (static_cast<int>(clamped) - low) * (largest_window - smallest_window) / (high - low);
}

std::vector<ManagedRouter::State>& ManagedRouter::states(const LinkLayer& link, MessageId message) {
    if (states_.size() <= message.index()) states_.resize(message.index() + 1);
    std::vector<State>& of_nodes = states_[message.index()];
    if (of_nodes.size() < link.size()) of_nodes.resize(link.size());
    return of_nodes;
}

void ManagedRouter::send(LinkLayer& link, NodeId node, MessageId message) {
    states(link, message)[node.index()].stage = Stage::own;
    link.send({.message = message,
               .sender = node,
               .path = link.key(node),
               .ttl = initial_ttl(),
               .hops = 1},
              std::nullopt, link.now());
}

void ManagedRouter::on_receive(LinkLayer& link, const Frame& frame,
                               std::span<Reception> receptions) {
    std::vector<State>& of_nodes = states(link, frame.message);
    relays_.clear();
    moves_.clear();
    for (Reception& reception : receptions) {
        reception.delivered = false;
        reception.fate = Fate::duplicate;
        State& mine = of_nodes[reception.node.index()];
        switch (act(link, frame, reception.node, mine)) {
            case Act::ignore: break;
            case Act::cancel:
                link.cancel(mine.copy);
                mine.stage = Stage::idle;
                break;
            case Act::move: moves_.push_back(&reception); break;
            case Act::relay: relays_.push_back(&reception); break;
        }
    }
    sort_by_keys(link, relays_);
    sort_by_keys(link, moves_);
    for (Reception* each : relays_) relay(link, frame, *each, of_nodes[each->node.index()]);
    for (Reception* each : moves_) move(link, *each, of_nodes[each->node.index()]);
}

/// Copy that a node has queued; null if it has none, or has sent it.
QueuedFrame* ManagedRouter::queued_copy(LinkLayer& link, MessageId message, NodeId node,
                                        State& mine) const {
    if (mine.stage != Stage::queued && mine.stage != Stage::late) return nullptr;
    QueuedFrame* copy = link.waiting(mine.copy);
    if (copy && copy->frame.message == message && copy->frame.sender == node) return copy;
    mine.stage = Stage::idle;
    return nullptr;
}

ManagedRouter::Act ManagedRouter::act(LinkLayer& link, const Frame& frame, NodeId node,
                                      State& mine) const {
    if (mine.stage == Stage::unheard) return Act::relay;  // M1
    if (mine.stage == Stage::own) return Act::ignore;
    const QueuedFrame* copy = queued_copy(link, frame.message, node, mine);
    if (!copy) return is_from_source(frame) ? Act::relay : Act::ignore;  // M6
    if (frame.ttl - 1 > copy->frame.ttl) return Act::relay;              // M5
    const std::string_view role = link.role(node);                       // M4
    if (is_from_source(frame) || role == "router") return Act::ignore;
    if (role == "router_late") return mine.stage == Stage::late ? Act::ignore : Act::move;
    return Act::cancel;
}

/// Queues a copy to relay, in place of the one that may be queued, unless the message ends here.
void ManagedRouter::relay(LinkLayer& link, const Frame& frame, Reception& r, State& mine) {
    const bool is_first = mine.stage == Stage::unheard, is_last = frame.ttl <= 1;
    const std::string_view role = link.role(r.node);
    r.delivered = is_first;
    if (is_last || role == "mute") {
        if (is_first) r.fate = is_last ? Fate::ttl : Fate::arrived;
        mine.stage = Stage::idle;
        return;
    }
    r.fate = Fate::waiting;
    if (queued_copy(link, frame.message, r.node, mine)) link.cancel(mine.copy);
    const int window = contention_window(link.snr(r));
    const double u = link.draw(Purpose::relay_slot, r.node, frame.message, mine.copies++);
    const int slots = role == "router" ? static_cast<int>(u * 2 * window)
                                       : router_slots + static_cast<int>(u * (1 << window));
    mine.window = static_cast<std::uint8_t>(window);
    mine.stage = Stage::queued;
    queue(link, passed_on(link, frame, r.node), r, slots, mine);
}

/// Moves the queued copy into the late window, after the slots of the others.
void ManagedRouter::move(LinkLayer& link, const Reception& r, State& mine) {
    const QueuedFrame copy = *link.waiting(mine.copy);
    link.cancel(mine.copy);
    mine.stage = Stage::late;
    queue(link, copy, r, router_slots + (1 << mine.window), mine);
}

void ManagedRouter::queue(LinkLayer& link, const QueuedFrame& copy, const Reception& r, int slots,
                          State& mine) {
    mine.copy =
        link.send(copy.frame, copy.heard_from, r.time + least_reaction + slots * settings_.slot)
            .value();
}

void ManagedRouter::forget(MessageId message) {
    if (message.index() < states_.size()) states_[message.index()] = {};  // and its memory
}

}  // namespace rovernet
