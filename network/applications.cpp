// SPDX-License-Identifier: MIT
#include "network/applications.hpp"

#include "network/world.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rovernet {

MessageId Applications::new_message(NodeId from, NodeId to, std::string payload,
                                    const SendOptions& options, bool is_routed) {
    has_sent_ = true;
    if (from.index() >= messages_sent_.size()) messages_sent_.resize(from.index() + 1);
    const std::uint32_t number = messages_sent_[from.index()]++;
    const auto length = static_cast<std::uint32_t>(payload.size());
    return world_.new_message({.origin = from,
                               .number = number,
                               .to = to,
                               .key = combine(world_.key(from), number),
                               .size = options.size.value_or(length),
                               .payload = std::move(payload),
                               .flow = options.flow,
                               .port = options.port,
                               .is_routed = is_routed});
}

/// Number of a message's destinations that a chain of links connects to the sender now, if a sink
/// requests it. Once the search has become expensive, kind_cheap_reachable is stopped for the run.
std::optional<std::uint32_t> Applications::reachable(NodeId from, NodeId to) {
    World& w = world_;
    if (reachability_.searches() > Reachability::cheap_searches + w.transmissions) {
        w.records.stop(kind_cheap_reachable);
    }
    if (!w.records.wants(kind_reachable | kind_cheap_reachable)) return std::nullopt;
    if (to != everyone) return reachability_.reaches(w.medium, from, to, w.now, w.legs) ? 1 : 0;
    if (w.settings.reference) return Reachability::count_anew(w.medium, from, w.now, w.legs);
    return reachability_.count(w.medium, from, w.now, w.legs);
}

/// Hops of the shortest chain of links to the destination of a unicast, if a sink requests it.
std::optional<std::uint32_t> Applications::shortest(NodeId from, NodeId to) {
    if (to == everyone || !world_.records.wants(kind_shortest)) return std::nullopt;
    return Reachability::shortest(world_.medium, from, to, world_.now, world_.legs);
}

bool Applications::is_routed(NodeId from, NodeId to, bool one_hop) const {
    if (to != everyone && (to.index() >= world_.size() || to == from)) {
        throw std::invalid_argument("a unicast needs a different robot as its destination");
    }
    if (one_hop) return false;
    const auto& router = routing_.router();
    if (to != everyone) return router && router->traits().routes_unicasts;
    if (!router) throw std::invalid_argument("no routing protocol: call route() before sending");
    return true;
}

std::optional<std::uint64_t> Applications::send(NodeId from, NodeId to, std::string payload,
                                                const SendOptions& options) {
    const bool routed = is_routed(from, to, options.one_hop);
    if (!world_.medium.stations().is_on(from)) return std::nullopt;
    const MessageId id = new_message(from, to, std::move(payload), options, routed);
    const Message& message = world_.messages[id];
    const std::uint64_t uid = message.uid;
    const Hops ttl = routed ? routing_.router()->initial_ttl(message) : Hops{1};
    const auto robots = static_cast<std::uint32_t>(to == everyone ? world_.size() : 2);
    world_.emit(Sent{world_.now, from, id, ttl, robots, reachable(from, to), shortest(from, to)});
    if (routed) {
        routing_.originate(from, id);
    } else {
        routing_.send_one_hop({.message = id,
                               .sender = from,
                               .path = world_.key(from),
                               .ttl = 1,
                               .hops = 1,
                               .next_hop = to});
    }
    world_.release(id);
    return uid;
}

void Applications::saturate(NodeId node, NodeId to, std::string payload,
                            const SendOptions& options) {
    if (!mac_.queues()) {
        throw std::invalid_argument("saturated traffic needs an access model: aloha or csma");
    }
    auto& flows = saturated_[node];
    flows.push_back({to, std::move(payload), options});
    for (int waiting = 0; waiting < 2; ++waiting) send_saturated(node, flows.back());
}

void Applications::send_saturated(NodeId from, Saturated& traffic) {
    traffic.waiting.push_back(world_.next_uid);
    if (!send(from, traffic.to, traffic.payload, traffic.options)) traffic.waiting.pop_back();
}

void Applications::left_queue(NodeId node, const Message& message, bool has_room) {
    const auto found = saturated_.find(node);
    if (found == saturated_.end()) return;
    for (Saturated& each : found->second) std::erase(each.waiting, message.uid);
    if (has_room) refill(node);
}

void Applications::refill(NodeId node) {
    const auto found = saturated_.find(node);
    if (found == saturated_.end()) return;
    auto& flows = found->second;
    for (std::size_t i = 0; i < flows.size(); ++i) {
        for (; flows[i].waiting.size() + flows[i].coming < 2; ++flows[i].coming) {
            world_.schedule(world_.now + least_reaction, Callback<>([this, node, &flows, i] {
                                --flows[i].coming;
                                send_saturated(node, flows[i]);
                            }));
        }
    }
}

void Applications::on_receive(NodeId id, Callback<const Heard&> react, HearOptions options) {
    if (id.index() >= reactions_.size()) reactions_.resize(id.index() + 1);
    reactions_[id.index()].push_back({std::move(react), options});
    if (options.level) world_.want_level_at(id);
}

void Applications::delivered(const Frame& frame, std::span<const Reception> receptions,
                             std::span<const Dbm> levels) {
    if (reactions_.empty()) return;
    reacting_.clear();
    for (std::size_t i = 0; i < receptions.size(); ++i) {
        if (receptions[i].delivered && reacts(receptions[i].node)) reacting_.push_back(i);
    }
    std::sort(reacting_.begin(), reacting_.end(), [&](std::size_t i, std::size_t k) {
        const Reception &a = receptions[i], &b = receptions[k];
        return a.time != b.time ? a.time < b.time : world_.key(a.node) < world_.key(b.node);
    });
    for (const std::size_t i : reacting_) {
        constexpr Dbm unknown{std::numeric_limits<double>::quiet_NaN()};
        world_.messages.hold(frame.message);
        const std::size_t slot = deliveries_.take();
        deliveries_[slot] = {.message = frame.message,
                             .last_hop = frame.sender,
                             .hops = frame.hops,
                             .level = levels.empty() ? unknown : levels[i]};
        world_.events.schedule(receptions[i].time + least_reaction, Priority::user,
                               {Occurrence::Kind::handed_over, receptions[i].node, slot});
    }
}

void Applications::react(NodeId id, std::size_t slot) {
    const Delivery delivery = deliveries_[slot];
    deliveries_.release(slot);
    const Message message = world_.messages[delivery.message];  // a copy: reactions may send
    world_.release(delivery.message);
    if (!world_.medium.stations().is_on(id)) return;
    // The list is read again in each step, because a reaction may add callbacks.
    for (std::size_t i = 0; i < reactions_[id.index()].size(); ++i) {
        const Reaction reaction = reactions_[id.index()][i];
        Heard heard{message, delivery.hops, delivery.last_hop};
        if (reaction.options.level) heard.level = delivery.level;
        reaction.call(heard);
    }
    reactions_[id.index()].erase_if([](const Reaction& each) { return each.call.has_ended(); });
}

/// Drops the messages that are on their way at the end of the run. The routing protocol may still
/// hold those to one robot.
void Applications::cut_off() {
    for (const auto& [id, at] : world_.messages.on_their_way()) {
        const Message& m = world_.messages[id];
        // Sent has the TTL of an application's message.
        const Hops ttl = m.kind.empty() ? Hops{1} : world_.messages.first_ttl(id);
        const Frame frame{.message = id, .sender = at, .ttl = ttl, .hops = 1, .next_hop = m.to};
        const bool is_held = m.is_routed && m.to != everyone;
        world_.emit(
            Dropped{world_.now, at, frame, is_held ? DropReason::held : DropReason::cut_off});
    }
}

}  // namespace rovernet
