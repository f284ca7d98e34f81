// SPDX-License-Identifier: MIT
#include "traces/ns2/ns2_reader.hpp"

#include "traces/ns2/ns2_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>  // order never observed
#include <utility>
#include <vector>

namespace rovernet {
namespace {

/// Fate of a frame whose reception at a MAC failed; a repeated unicast is also dropped there.
std::optional<Fate> loss_of(std::string_view reason) {
    if (reason == "DUP") return Fate::duplicate;
    std::optional<Fate> found;
    for_each_reason([&](auto each) {
        if constexpr (std::is_same_v<decltype(each), Fate>) {
            if (reason_of(each) == LossReason{reason, "MAC"}) found = each;
        }
    });
    return found;
}

/// Reason of a drop outside a reception.
std::optional<DropReason> drop_of(std::string_view reason, std::string_view layer) {
    std::optional<DropReason> found;
    for_each_reason([&](auto each) {
        if constexpr (std::is_same_v<decltype(each), DropReason>) {
            if (reason_of(each) == LossReason{reason, layer}) found = each;
        }
    });
    return found;
}

/// Robots that have received a message. Most messages are for one robot.
class Getters {
  public:
    /// Adds a robot; false if it has received the message before.
    bool add(NodeId node) {
        if (first_ == everyone)
            first_ = node;
        else if (first_ == node)
            return false;
        else
            return add_other(node.index());
        return true;
    }

  private:
    bool add_other(std::size_t robot) {
        if (others_.size() <= robot) others_.resize(robot + 1);
        if (others_[robot]) return false;
        return others_[robot] = true;
    }
    NodeId first_ = everyone;
    std::vector<bool> others_;  ///< by robot
};

/// Converts events to records.
class Replay {
  public:
    Replay(Sink sink, Ns2File& file, const OnNs2Packet& on_packet)
        : sink_(std::move(sink)), file_(file), on_packet_(on_packet), context_{legs_, messages_} {}

    void on(const Ns2Packet&);
    void on(const Ns2Move&);
    void on(const Ns2Reachable& r) { reachable_ = r; }
    template <class Other>
    void on(const Other&) {}
    /// Emits the last reception, which is complete.
    void flush();

  private:
    struct Copy {
        Frame frame;
        Reception reception;
    };
    /// Data of a message in the file so far.
    struct Known {
        std::int64_t ttl = 0;    ///< as its first frame carries it
        bool is_on_air = false;  ///< the origin has put it on air
        Getters getters;
    };
    using Flow = std::tuple<std::string, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

    /// Handles a sending; true if the line begins a message.
    bool sent(const Ns2Packet&);
    void carried(const Ns2Packet&, MessageId);
    void received(const Ns2Packet&, MessageId);
    void delivered(const Ns2Packet&, MessageId);
    void dropped(const Ns2Packet&, MessageId);
    bool goes_on(const Ns2Packet&, MessageId) const;
    std::optional<MessageId> message_of(const Ns2Packet&) const;
    std::uint32_t flow_of(const Ns2Packet&);
    std::optional<NodeId> heard_from(const Ns2Packet&) const;
    Frame frame_of(const Ns2Packet&, MessageId) const;
    Known& known(MessageId id) { return known_[id.index()]; }
    void know(NodeId node);
    template <class R>
    void emit(const R& record) {
        if (sink_.kinds() & kind_of<R>()) sink_.on(record, context_);
    }

    Sink sink_;
    Ns2File& file_;
    const OnNs2Packet& on_packet_;
    Legs legs_;
    MessageTable messages_;
    RecordContext context_;
    std::map<std::string, std::unordered_map<std::uint64_t, MessageId>, std::less<>> by_type_;
    std::map<Flow, std::uint32_t> flows_;
    std::vector<Known> known_;               ///< by MessageId
    std::vector<std::uint32_t> numbers_;     ///< by robot: its messages so far
    std::vector<bool> seen_;                 ///< by robot: the file has told of it
    std::uint32_t robots_ = 0;               ///< robots that it has told of
    std::optional<Ns2Reachable> reachable_;  ///< the last annotation
    std::optional<Copy> open_;               ///< a reception that the next lines may go on with
};

void Replay::know(NodeId node) {
    while (legs_.size() <= node.index()) legs_.add(Leg{});
    seen_.resize(legs_.size());
    numbers_.resize(legs_.size());
    if (!seen_[node.index()]) ++robots_;
    seen_[node.index()] = true;
}

void Replay::on(const Ns2Move& m) {
    flush();
    know(m.node);
    legs_.replace(m.node, leg_of(m));
    emit(Moved{m.time, m.node, legs_.leg(m.node)});
}

std::optional<MessageId> Replay::message_of(const Ns2Packet& p) const {
    if (!p.ip || p.ip->from_port == routing_port) return std::nullopt;
    const auto of_type = by_type_.find(p.type);
    if (of_type == by_type_.end()) return std::nullopt;
    const auto found = of_type->second.find(p.uid);
    if (found == of_type->second.end()) return std::nullopt;
    return found->second;
}

std::uint32_t Replay::flow_of(const Ns2Packet& p) {
    const auto next = static_cast<std::uint32_t>(flows_.size() + 1);
    return flows_
        .try_emplace({std::string(p.type), p.ip->from, p.ip->from_port, p.ip->to, p.ip->to_port},
                     next)
        .first->second;
}

bool Replay::sent(const Ns2Packet& p) {
    flush();
    if (!p.ip || p.ip->from_port == routing_port || p.type == "ack") return false;
    const auto [entry, is_new] = by_type_[std::string(p.type)].try_emplace(p.uid);
    if (!is_new) {
        file_.refuse(p.uid_column, fmt::format("a packet of type {} with number {} is sent a "
                                               "second time; expected a different number for "
                                               "each packet of a type",
                                               p.type, p.uid));
        return false;
    }
    const bool for_one = p.ip->to >= 0;
    const NodeId to =
        for_one && p.ip->to < most_robots ? NodeId{static_cast<std::uint32_t>(p.ip->to)} : everyone;
    constexpr std::uint64_t largest = 0xffffffff;
    const MessageId id =
        messages_.add({.origin = p.node,
                       .uid = p.uid,
                       .number = numbers_[p.node.index()]++,
                       .to = to,
                       .key = 0,
                       .size = static_cast<std::uint32_t>(std::min(p.size.value_or(0), largest)),
                       .created = p.time,
                       .payload = {},
                       .flow = flow_of(p)});
    entry->second = id;
    known_.push_back({.ttl = p.ip->ttl, .is_on_air = false, .getters = {}});
    constexpr std::int64_t most_hops = 65535;
    const auto ttl = static_cast<Hops>(std::clamp<std::int64_t>(p.ip->ttl, 0, most_hops));
    Sent record{p.time, p.node, id, ttl, for_one ? 2 : std::max(robots_, 1U), std::nullopt};
    if (reachable_ && reachable_->uid == p.uid) record.reachable = reachable_->robots;
    reachable_.reset();
    emit(record);
    return true;
}

/// Robot that transmitted the packet, if a MAC header names it. Some MACs write other numbers.
std::optional<NodeId> Replay::heard_from(const Ns2Packet& p) const {
    if (!p.mac || !p.mac->has_sent()) return std::nullopt;
    if (p.mac->from >= seen_.size() || !seen_[p.mac->from]) return std::nullopt;
    return NodeId{p.mac->from};
}

Frame Replay::frame_of(const Ns2Packet& p, MessageId id) const {
    constexpr std::int64_t most_hops = 65535;
    const std::int64_t ttl = std::clamp<std::int64_t>(p.ip->ttl, 0, most_hops);
    const std::int64_t first = std::clamp<std::int64_t>(known_[id.index()].ttl, 0, most_hops);
    const bool is_sender = p.layer == "RTR" && (p.op == 's' || p.op == 'f');
    return {.message = id,
            .sender = is_sender ? p.node : heard_from(p).value_or(p.node),
            .path = 0,
            .ttl = static_cast<Hops>(ttl),
            .hops = static_cast<Hops>(std::clamp<std::int64_t>(first - ttl + 1, 0, most_hops))};
}

/// Whether the line continues the reception of the previous line.
bool Replay::goes_on(const Ns2Packet& p, MessageId id) const {
    return open_ && open_->frame.message == id && open_->reception.node == p.node &&
           open_->reception.time == p.time && open_->reception.fate == Fate::waiting;
}

void Replay::carried(const Ns2Packet& p, MessageId id) {
    Known& message = known(id);
    if (p.node == messages_[id].origin && !std::exchange(message.is_on_air, true)) {
        message.ttl = p.ip->ttl;
    }
    emit(Transmitted{p.time, frame_of(p, id), heard_from(p)});
}

void Replay::received(const Ns2Packet& p, MessageId id) {
    const bool is_own_on_its_way_down = !p.mac || !p.mac->has_sent();
    if (is_own_on_its_way_down) return;
    open_ = Copy{frame_of(p, id), {p.time, p.node, Fate::waiting, false}};
}

void Replay::delivered(const Ns2Packet& p, MessageId id) {
    const bool is_open = goes_on(p, id);
    if (!is_open) flush();
    if (p.node == messages_[id].origin || !known(id).getters.add(p.node)) return;
    if (!is_open) open_ = Copy{frame_of(p, id), {p.time, p.node, Fate::waiting, false}};
    open_->reception.delivered = true;
}

void Replay::dropped(const Ns2Packet& p, MessageId id) {
    const bool by_router = p.layer == "RTR" && (p.reason == "TTL" || p.reason == "DUP");
    if (by_router && goes_on(p, id)) {
        open_->reception.fate = p.reason == "TTL" ? Fate::ttl : Fate::duplicate;
        return;
    }
    flush();
    if (const auto reason = drop_of(p.reason, p.layer)) {
        emit(Dropped{p.time, p.node, frame_of(p, id), *reason});
    } else if (const auto fate = loss_of(p.reason); fate && p.layer == "MAC") {
        open_ = Copy{frame_of(p, id), {p.time, p.node, *fate, false}};
    }
}

void Replay::on(const Ns2Packet& p) {
    know(p.node);
    if (p.layer == "AGT" && p.op == 's') {
        if (sent(p) && on_packet_) on_packet_(p, &messages_[*message_of(p)]);
        return;
    }
    const bool is_frame = p.layer == "MAC" && p.op != 'D';  // every one of them, many to a message
    const std::optional<MessageId> id = is_frame ? std::nullopt : message_of(p);
    const bool may_go_on = id && (p.op == 'D' || (p.op == 'r' && p.layer == "AGT"));
    if (!may_go_on) flush();
    if (id) {
        if (p.op == 'D') {
            dropped(p, *id);
        } else if (p.op == 'r' && p.layer == "AGT") {
            delivered(p, *id);
        } else if (p.layer == "RTR" && p.op == 'r') {
            received(p, *id);
        } else if (p.layer == "RTR" && (p.op == 's' || p.op == 'f')) {
            carried(p, *id);
        }
    }
    if (on_packet_) on_packet_(p, id ? &messages_[*id] : nullptr);
}

void Replay::flush() {
    if (!open_) return;
    emit(Received{open_->frame, {&open_->reception, 1}});
    open_.reset();
}

}  // namespace

Ns2Counts read_ns2_trace(Ns2Source source, Sink sink, Ns2Strictness strictness,
                         const OnNs2Packet& on_packet) {
    Ns2File file(std::move(source), strictness);
    Replay replay(std::move(sink), file, on_packet);
    while (const Ns2Line* line = file.next()) {
        std::visit([&](const auto& event) { replay.on(event); }, *line);
    }
    replay.flush();
    file.expect_trace();
    return file.counts();
}

}  // namespace rovernet
