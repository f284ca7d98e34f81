// SPDX-License-Identifier: MIT
#include "routing/dsr/dsr_router.hpp"

#include "routing/in_order.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rovernet {
namespace {

using dsr::Path;

// Time that a packet may wait for routes (4.2).
// TTL of messages and of control packets with a route, as ns-2 has them.
constexpr Hops message_ttl = 32;

}  // namespace

Dsr::operator Router() const {
    if (promiscuous) return PromiscuousDsrRouter{*this};
    return DsrRouter{*this};
}

DsrRouter::DsrRouter(const Dsr& dsr) : dsr_(dsr) { check_fields(dsr, "dsr"); }

Hops DsrRouter::initial_ttl() const { return message_ttl; }

DsrRouter::Node& DsrRouter::node(NodeId id) {
    if (nodes_.size() <= id.index()) nodes_.resize(id.index() + 1);
    return nodes_[id.index()];
}

std::uint32_t DsrRouter::add_header(const Header& header) {
    if (free_headers_.empty()) {
        headers_.push_back(header);
        return static_cast<std::uint32_t>(headers_.size());
    }
    const std::uint32_t number = free_headers_.back();
    free_headers_.pop_back();
    headers_[number - 1] = header;
    return number;
}

std::vector<RouteState> DsrRouter::routes(NodeId at, Time) const {
    if (at.index() >= nodes_.size()) return {};
    const dsr::Cache& cache = nodes_[at.index()].cache;
    std::map<NodeId, RouteState> shortest;
    for (const auto& known : {cache.own(), cache.others()}) {
        for (const auto& [path, since] : known) {
            for (std::size_t i = 1; i < path.size(); ++i) {
                RouteState& best = shortest[path[i]];
                if (best.hops != 0 && best.hops <= i) continue;
                best = {.destination = path[i],
                        .next_hop = path[1],
                        .hops = static_cast<Hops>(i),
                        .since = since,
                        .path = {path.begin() + 1, path.begin() + i + 1}};
            }
        }
    }
    std::vector<RouteState> all;
    for (auto& [destination, route] : shortest) all.push_back(std::move(route));
    return all;
}

FrameHeader DsrRouter::header_bytes(const Frame& frame) const {
    const Header& h = header(frame);
    const auto hop = static_cast<std::size_t>(frame.hops - h.first_hops);
    return {dsr::protocol, dsr::message_header(h.path, h.salvage, hop)};
}

std::size_t DsrRouter::pairs_too_far() const {
    return static_cast<std::size_t>(std::count_if(
        too_far_.begin(), too_far_.end(), [](const auto& each) { return each.second.has_lost; }));
}

std::string DsrRouter::notice() const {
    const std::size_t pairs = pairs_too_far();
    if (pairs == 0) return {};
    return fmt::format(
        "dsr: messages between {0} pair{1} of robots were lost, because a route request passed {2} "
        "robots without finding the destination; a route of dsr has at most {2} robots",
        pairs, pairs == 1 ? "" : "s", Path::longest);
}

void DsrRouter::forget(MessageId message) {
    if (message.index() < arrived_.size()) arrived_[message.index()] = false;
}

bool DsrRouter::keeps(MessageId message) const {
    return std::any_of(nodes_.begin(), nodes_.end(), [&](const Node& each) {
        const auto& packets = each.buffer.packets();
        return std::any_of(packets.begin(), packets.end(),
                           [&](const auto& p) { return p.queued.frame.message == message; });
    });
}

/// A node that is switched off loses what it knows, but for the number of its last request, which
/// others remember.
void DsrRouter::on_switched(LinkLayer& link, NodeId at, bool on) {
    if (on) return;
    Node& here = node(at);
    for (const auto& packet : here.buffer.take_all()) lose(link, at, packet, DropReason::off);
    const std::uint16_t request = here.request;
    here = {};
    here.request = request;
}

void DsrRouter::send(LinkLayer& link, NodeId at, MessageId id) {
    const Message& message = link.message(id);
    const NodeId to = message.to;
    QueuedFrame own{.frame = {.message = id,
                              .sender = at,
                              .path = link.key(at),
                              .ttl = initial_ttl(),
                              .hops = 1,
                              .bytes = message.size + dsr::ip_header}};
    const Time now = link.now();
    if (to == everyone) {
        own.frame.ttl = 1;
        link.send(own.frame, {}, now);
    } else if (const auto path = node(at).cache.find(to)) {
        send_along(link, own, *path, 0, now);
    } else {
        keep(link, at, own);
        search(link, at, to, now);
    }
}

/// Sends a message along a route (8.1.3). In the option, a salvaged message's route has its first
/// node, too, as that is not the message's source (8.3.6).
void DsrRouter::send_along(LinkLayer& link, const QueuedFrame& queued, const Path& path,
                           unsigned salvage, Time at) {
    Frame frame = queued.frame;
    const std::size_t addresses = path.size() - (salvage > 0 ? 1 : 2);
    frame.next_hop = path[1];
    frame.bytes = link.message(frame.message).size + dsr::ip_header + dsr::fixed_header +
                  dsr::route_option(addresses);
    const bool is_read = !is_ns2() || salvage > 0 || is_new_flow(frame.sender, path);
    frame.header = add_header({path, static_cast<std::uint8_t>(salvage), frame.hops, is_read});
    link.send(frame, queued.heard_from, at);
}

/// Counts a message along a route. @return whether it is one of the first three, which establish
/// the flow; with the flow state of ns-2, the others have no route that a node could read
bool DsrRouter::is_new_flow(NodeId source, const Path& path) {
    auto& flows = node(source).flows;
    auto flow = std::find_if(flows.begin(), flows.end(),
                             [&](const Flow& each) { return each.path.back() == path.back(); });
    if (flow == flows.end()) flow = flows.insert(flow, Flow{path});
    if (!(flow->path == path)) *flow = {path};
    return ++flow->messages <= 3;
}

/// Lets a packet wait for a route; set_timer() is to follow.
void DsrRouter::keep(LinkLayer& link, NodeId at, const QueuedFrame& queued) {
    const Message& message = link.message(queued.frame.message);
    const Time until =
        std::max(message.created + SendBuffer::longest_wait, link.now() + least_reaction);
    link.hold(queued.frame);
    const auto oldest =
        node(at).buffer.add({message.to, queued, until}, static_cast<std::size_t>(dsr_.buffer));
    if (oldest) lose(link, at, *oldest, DropReason::buffer_full);
}

/// Ends a packet that waited. One that waited in vain has no route if requests for it became full.
/// The next packet gets all requests of a search anew.
void DsrRouter::lose(LinkLayer& link, NodeId at, const SendBuffer::Packet& packet,
                     DropReason reason) {
    if (reason == DropReason::timeout || reason == DropReason::no_route) {
        const auto far = too_far_.find({at, packet.destination});
        const Time created = link.message(packet.queued.frame.message).created;
        if (far != too_far_.end() && far->second.last >= created) {
            far->second.has_lost = true;
            reason = DropReason::no_route;
        }
    }
    if (!has_own(at, packet.destination)) {
        for (Search& each : node(at).searches)
            if (each.target == packet.destination) each.requests = 0;
    }
    link.drop(at, packet.queued.as_received(), reason);
    link.release(packet.queued.frame);
}

void DsrRouter::on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
    const Message& message = link.message(frame.message);
    if (message.kind.empty()) {
        return in_order(link, receptions,
                        [&](Reception& each) { receive_message(link, frame, each); });
    }
    const dsr::Packet packet = dsr::packet_of(message);
    in_order(link, receptions, [&](Reception& each) {
        each.fate = Fate::arrived;
        receive_control(link, frame, packet, each);
    });
}

void DsrRouter::receive_message(LinkLayer& link, const Frame& frame, Reception& r) {
    const Message& message = link.message(frame.message);
    r.fate = Fate::arrived;
    r.delivered = message.to == everyone;
    if (frame.header == 0) return;  // a broadcast, or no message of this protocol
    const Path path = header(frame).path;
    const Way way{path, static_cast<std::size_t>(frame.hops - header(frame).first_hops)};
    const bool is_read = header(frame).is_read;
    if (!is_ns2()) learn(r.node, frame.sender, path, dsr::Cache::Origin::others, r.time);
    if (frame.next_hop != r.node) {
        if (is_read) shorten(link, frame.sender, way, r);
    } else if (message.to == r.node) {
        const std::size_t i = frame.message.index();
        if (i >= arrived_.size()) arrived_.resize(i + 1);
        r.delivered = !arrived_[i];
        if (arrived_[i]) r.fate = Fate::duplicate;
        arrived_[i] = true;
    } else {
        receive_on(link, frame, way, r);
    }
    end_searches(link, r.node, r.time + least_reaction);
}

/// Passes a packet on along its route (8.1.5).
void DsrRouter::receive_on(LinkLayer& link, const Frame& frame, Way way, Reception& r) {
    r.fate = frame.ttl > 1 ? Fate::waiting : Fate::ttl;
    if (frame.ttl <= 1) return;
    Frame onward = frame;
    onward.sender = r.node;
    onward.path = combine(frame.path, link.key(r.node));
    --onward.ttl;
    ++onward.hops;
    onward.next_hop = way.path[way.sender + 2];
    link.send(onward, frame.sender, r.time + least_reaction);
}

void DsrRouter::on_sent(LinkLayer& link, const QueuedFrame& queued, SendResult result) {
    if (result == SendResult::acked || result == SendResult::sent) return;
    const NodeId at = queued.frame.sender, next_hop = queued.frame.next_hop;
    const Message& message = link.message(queued.frame.message);
    if (result != SendResult::retries) {
        if (!message.kind.empty() || message.to == everyone) return;
        return link.drop(at, queued.as_received(), drop_reason_of(result));
    }
    std::vector<QueuedFrame> stranded = link.take_queued(at, next_hop);
    stranded.insert(stranded.begin(), queued);
    on_broken(link, at, next_hop, stranded);
    for (std::size_t i = 1; i < stranded.size(); ++i) link.release(stranded[i].frame);
}

/// Reports a broken link to the source of each packet that was on its way over it, and sends the
/// messages on other routes (3.4.1, 3.4.2, 8.3.4).
void DsrRouter::on_broken(LinkLayer& link, NodeId at, NodeId neighbour,
                          std::span<const QueuedFrame> stranded) {
    Node& here = node(at);
    here.cache.remove_link(at, neighbour);
    for (const QueuedFrame& each : stranded) {
        const Message& message = link.message(each.frame.message);
        const bool is_control = !message.kind.empty();
        const Header own{.path = is_control ? dsr::packet_of(message).route.value_or(Path{at, at})
                                            : header(each.frame).path,
                         .salvage = is_control ? std::uint8_t{0} : header(each.frame).salvage,
                         .first_hops = is_control ? Hops{1} : header(each.frame).first_hops};
        const dsr::Error error{at, own.path.front(), neighbour, own.salvage};
        if (error.to == at) {
            here.error = error;
            here.error_time = link.now();
        } else {
            const auto made = static_cast<std::size_t>(each.frame.hops - own.first_hops);
            send_packet(link, at, {.error = error, .route = own.path.first(made + 1).reversed()},
                        dsr::error_kind, link.now());
        }
    }
    for (const QueuedFrame& each : stranded) {
        if (link.message(each.frame.message).kind.empty()) send_otherwise(link, at, each);
    }
    set_timer(link, at);
}

/// How often a message has changed its route on its way once a node sends it along a new one.
unsigned DsrRouter::salvage_of(const QueuedFrame& queued) const {
    return queued.heard_from ? header(queued.frame).salvage + 1U : 0;
}

/// Sends a message whose next hop is gone along another route (8.3.6): its source waits for one if
/// it knows none, others salvage the message.
void DsrRouter::send_otherwise(LinkLayer& link, NodeId at, const QueuedFrame& queued) {
    const NodeId to = link.message(queued.frame.message).to;
    const unsigned salvage = salvage_of(queued);
    const bool may = salvage <= static_cast<unsigned>(dsr_.salvage);
    const auto path = node(at).cache.find(to);
    if (may && path) return send_along(link, queued, *path, salvage, link.now());
    if (salvage == 0 || (may && is_ns2())) {
        keep(link, at, queued);
        return search(link, at, to, link.now());
    }
    link.drop(at, queued.as_received(), path ? DropReason::salvaged : DropReason::broken);
}

}  // namespace rovernet
