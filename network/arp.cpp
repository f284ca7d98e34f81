// SPDX-License-Identifier: MIT
#include "network/arp.hpp"

#include "network/world.hpp"
#include "routing/arp_packet.hpp"

#include <algorithm>
#include <utility>

namespace rovernet {

Arp::Entry* Arp::find(NodeId node, NodeId neighbour) {
    if (node.index() >= entries_.size()) return nullptr;
    auto& all = entries_[node.index()];
    const auto place = std::lower_bound(all.begin(), all.end(), neighbour,
                                        [](const Entry& e, NodeId n) { return e.neighbour < n; });
    return place == all.end() || place->neighbour != neighbour ? nullptr : &*place;
}

Arp::Entry& Arp::add(NodeId node, NodeId neighbour) {
    if (Entry* known = find(node, neighbour)) return *known;
    if (node.index() >= entries_.size()) entries_.resize(world_.size());
    auto& all = entries_[node.index()];
    const auto place = std::lower_bound(all.begin(), all.end(), neighbour,
                                        [](const Entry& e, NodeId n) { return e.neighbour < n; });
    return *all.insert(place, {neighbour, start_of_run - Duration{1}});
}

bool Arp::is_known(const Entry& entry) const { return world_.now <= entry.until; }

bool Arp::admits(const QueuedFrame& frame) {
    Entry& entry = add(frame.frame.sender, frame.frame.next_hop);
    if (is_known(entry)) return true;
    const bool is_over = entry.requests == most_requests;
    const auto displaced = std::exchange(entry.held, frame);
    ask(frame.frame.sender, entry);  // may add entries: this one is not used behind it
    if (displaced) user_.unresolved(*displaced, !is_over);
    return false;
}

void Arp::set_event(Entry& entry, NodeId node, Time due) {
    entry.due = due;
    world_.events.schedule(due, Priority::timer,
                           {Occurrence::Kind::arp, node, entry.neighbour.value});
}

void Arp::ask(NodeId node, Entry& entry) {
    if (entry.requests == most_requests) {
        entry.requests = 0;
        entry.due = never;
        if (const auto held = std::exchange(entry.held, std::nullopt)) {
            user_.unresolved(*held, false);
        }
        return;
    }
    ++entry.requests;
    set_event(entry, node, world_.now + answer_time);
    send(node, entry.neighbour, everyone, arp::request_kind);
}

void Arp::on_timer(NodeId node, NodeId neighbour) {
    Entry* entry = find(node, neighbour);
    if (!entry || entry->due != world_.now) return;
    entry->due = never;
    if (entry->requests > 0) return ask(node, *entry);
    const auto held = std::exchange(entry->held, std::nullopt);
    if (std::exchange(entry->owes_reply, false)) send(node, neighbour, neighbour, arp::reply_kind);
    if (held) user_.send_resolved(*held);
}

void Arp::send(NodeId from, NodeId to, NodeId next_hop, std::string_view kind) {
    if (from.index() >= packets_.size()) packets_.resize(world_.size());
    const std::uint32_t number = packets_[from.index()]++;
    constexpr std::uint64_t own = 0x617270;  // apart from applications' messages
    const MessageId id = world_.new_message({.origin = from,
                                             .number = number,
                                             .to = to,
                                             .key = combine(combine(world_.key(from), own), number),
                                             .size = arp::packet_bytes,
                                             .payload = {},
                                             .kind = kind});
    user_.send_resolved({{.message = id,
                          .sender = from,
                          .path = world_.key(from),
                          .ttl = 1,
                          .hops = 1,
                          .next_hop = next_hop}});
}

/// Serves a packet at its receivers: all learn the address of its sender, as in ns-2 (by RFC 826
/// only the asked node, and nodes that knew the sender); the asked node answers.
void Arp::receive(const Frame& frame, std::span<Reception> receptions) {
    const Message& packet = world_.messages[frame.message];
    for (Reception& r : receptions) {
        r.fate = Fate::arrived;
        r.delivered = false;
        Entry& entry = add(r.node, frame.sender);
        if (r.node == packet.to && packet.kind == arp::request_kind) entry.owes_reply = true;
        learn(entry, r.node, r.time);
    }
}

void Arp::learn(Entry& entry, NodeId node, Time time) {
    entry.until = timeout_ ? time + *timeout_ : never;
    entry.requests = 0;
    entry.due = never;
    if (entry.held || entry.owes_reply) set_event(entry, node, time + least_reaction);
}

std::optional<QueuedFrame> Arp::take(NodeId node, NodeId next_hop, const FrameTest& is_taken) {
    Entry* entry = find(node, next_hop);
    const bool takes = entry && entry->held && is_taken(entry->held->frame);
    return takes ? std::exchange(entry->held, std::nullopt) : std::nullopt;
}

std::vector<QueuedFrame> Arp::switch_off(NodeId node) {
    std::vector<QueuedFrame> frames;
    if (node.index() >= entries_.size()) return frames;
    for (const Entry& entry : std::exchange(entries_[node.index()], {})) {
        if (entry.held) frames.push_back(*entry.held);
    }
    return frames;
}

}  // namespace rovernet
