// SPDX-License-Identifier: MIT
#include "routing/suppression/cluster_router.hpp"

#include "routing/big_endian.hpp"
#include "routing/relay.hpp"

#include <algorithm>
#include <string>

namespace rovernet {
namespace {

constexpr std::string_view hello_kind = "SUPPRESSION HELLO";
/// IP and UDP, addresses of the sender and of its head [bytes].
constexpr std::uint32_t hello_bytes = 28 + 8;
/// HELLO periods after which a silent neighbour is forgotten.
constexpr int memory = 3;

}  // namespace

ClusterRouter::ClusterRouter(const Suppression& suppression) : settings_(suppression) {
    check_fields(suppression, "suppression");
    if (suppression.threshold) {
        throw_out_of_range("suppression", "threshold", "left out for scheme \"cluster\"",
                           *suppression.threshold);
    }
    if (suppression.hello == Duration{0})
        throw_out_of_range("suppression", "hello", "> 0 s for scheme \"cluster\"", 0);
}

ClusterRouter::Node& ClusterRouter::node(NodeId id) {
    if (id.index() >= nodes_.size()) nodes_.resize(id.index() + 1);
    return nodes_[id.index()];
}

/// Whether each node has heard a message.
std::vector<bool>& ClusterRouter::heard(const LinkLayer& link, MessageId message) {
    if (heard_.size() <= message.index()) heard_.resize(message.index() + 1);
    std::vector<bool>& of_nodes = heard_[message.index()];
    if (of_nodes.size() < link.size()) of_nodes.resize(link.size());
    return of_nodes;
}

void ClusterRouter::on_start(LinkLayer& link, NodeId at) {
    const double u = link.draw(Purpose::hello, at, node(at).hellos++);
    link.timer(at, link.now() + from_seconds(u * seconds(settings_.hello)), 0);
}

/// Sends a HELLO, and sets the timer of the next one: 0.75 to 1.25 periods later.
void ClusterRouter::on_timer(LinkLayer& link, NodeId at, std::uint64_t /*tag*/) {
    const double u = link.draw(Purpose::hello, at, node(at).hellos++);
    link.timer(at, link.now() + from_seconds((0.75 + u / 2) * seconds(settings_.hello)), 0);
    if (!link.is_on(at)) return;
    join(link, at);
    std::string bytes;
    big_endian::put(bytes, head(at).value);
    const MessageId hello = link.originate(at, everyone, hello_kind, hello_bytes, bytes);
    link.send({.message = hello, .sender = at, .path = link.key(at), .ttl = 1, .hops = 1},
              std::nullopt, link.now());
    link.release(hello);
}

/// A node that is switched off forgets its neighbours.
void ClusterRouter::on_switched(LinkLayer& /*link*/, NodeId at, bool on) {
    if (!on) node(at).head = everyone, node(at).neighbours.clear();
}

/// Whether a neighbour was heard lately.
bool ClusterRouter::is_near(const Neighbour& each, Time now) const {
    return now - each.last <= memory * settings_.hello;
}

/// Chooses the head of a node among itself and its neighbours.
void ClusterRouter::join(const LinkLayer& link, NodeId at) {
    Node& mine = node(at);
    std::erase_if(mine.neighbours, [&](const auto& each) { return !is_near(each, link.now()); });
    mine.head = at;
    for (const Neighbour& each : mine.neighbours) {
        if (each.head == each.node && link.key(each.node) < link.key(mine.head))
            mine.head = each.node;
    }
}

bool ClusterRouter::is_relay(NodeId at, Time now) const {
    if (head(at) == at || head(at) == everyone) return true;
    const auto& all = nodes_[at.index()].neighbours;
    return std::any_of(all.begin(), all.end(), [&](const Neighbour& each) {
        return each.head != head(at) && is_near(each, now);
    });
}

void ClusterRouter::hear_hello(NodeId at, const Neighbour& sender) {
    auto& all = node(at).neighbours;
    const auto known = std::find_if(
        all.begin(), all.end(), [&](const Neighbour& each) { return each.node == sender.node; });
    known == all.end() ? all.push_back(sender) : void(*known = sender);
}

void ClusterRouter::send(LinkLayer& link, NodeId at, MessageId message) {
    heard(link, message)[at.index()] = true;
    link.send(
        {.message = message, .sender = at, .path = link.key(at), .ttl = initial_ttl(), .hops = 1},
        std::nullopt, link.now());
}

void ClusterRouter::on_receive(LinkLayer& link, const Frame& frame,
                               std::span<Reception> receptions) {
    const Message& message = link.message(frame.message);
    if (message.kind == hello_kind) {
        for (Reception& r : receptions) {
            r.fate = Fate::arrived;
            hear_hello(r.node, {frame.sender, NodeId{big_endian::get(message.payload, 0)}, r.time});
        }
        return;
    }
    std::vector<bool>& has_heard = heard(link, frame.message);
    news_.clear();
    for (Reception& r : receptions) {
        r.delivered = !has_heard[r.node.index()];
        r.fate = Fate::duplicate;
        if (r.delivered) news_.push_back(&r);
        has_heard[r.node.index()] = true;
    }
    sort_by_keys(link, news_);
    for (Reception* each : news_) take(link, frame, *each);
}

/// First copy of a message at a node.
void ClusterRouter::take(LinkLayer& link, const Frame& frame, Reception& r) {
    if (frame.ttl <= 1 || !is_relay(r.node, r.time)) {
        r.fate = frame.ttl <= 1 ? Fate::ttl : Fate::arrived;
        return;
    }
    r.fate = Fate::waiting;
    const double u = link.draw(Purpose::assessment, r.node, frame.message, 0);
    const QueuedFrame copy = passed_on(link, frame, r.node);
    link.send(copy.frame, copy.heard_from,
              r.time + least_reaction + from_seconds(u * seconds(settings_.delay)));
}

void ClusterRouter::forget(MessageId message) {
    if (message.index() < heard_.size()) heard_[message.index()] = {};  // and its memory
}

}  // namespace rovernet
