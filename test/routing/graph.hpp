// SPDX-License-Identifier: MIT
#pragma once

#include "sim/link_layer.hpp"
#include "sim/random.hpp"
#include "sim/router.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::test {

/// Graph on which any routing protocol runs without radio. A frame takes `hop_time` to each
/// neighbour, and no frame is lost. A unicast over a missing edge fails with `retries`. With
/// `faults`, frames are also lost or late.
class Graph final : public LinkLayer {
  public:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    static constexpr Duration hop_time{1'000'000};

    /// @param edges  pairs of nodes that hear each other
    Graph(std::size_t nodes, const std::vector<Edge>& edges, Router router)
        : nodes_(nodes), router_(std::move(router)) {
        for (const Edge& edge : edges) join(edge.first, edge.second);
        for (std::uint32_t i = 0; i < nodes; ++i) router_.on_start(*this, NodeId{i});
        send_outbox();
    }

    /// Faults of frames: share of lost frames, share of unicasts whose acknowledgement is lost [-],
    /// longest time of a frame [ns], and seed of the draws.
    struct Faults {
        double loss = 0, unnoticed = 0;
        Duration longest = hop_time;
        std::uint64_t seed = 0;
    };
    Faults faults{};
    /// Seed of the protocol's random draws.
    std::uint64_t seed = 0;
    /// Positions of nodes [m]; nodes beyond the end are at the origin.
    std::vector<Vec3> positions{};
    /// Signal to noise ratio [dB] at which `to` hears `from`; 30 dB if not given.
    std::function<Db(NodeId from, NodeId to)> snr_between{};
    /// Roles of nodes; nodes beyond the end have no role.
    std::vector<std::string_view> roles{};
    /// Keys of nodes; a node beyond the end has its id as its key.
    std::vector<std::uint64_t> keys{};
    /// Called when a frame is sent.
    std::function<void(const Frame&)> on_transmit{};
    /// Called after each event.
    std::function<void()> after_event{};
    /// Called when a message of an application arrives at a node.
    std::function<void(const Message&, NodeId)> on_message_at{};

    /// Calls `act` at `time`.
    void at(Time time, std::function<void()> act) { schedule(time, std::move(act)); }
    void switch_node(std::uint32_t node, bool on) {
        if (on ? off_.erase(node) == 0 : !off_.insert(node).second) return;
        router_.on_switched(*this, NodeId{node}, on);
        send_outbox();
    }
    void join(std::uint32_t a, std::uint32_t b) { edges_.insert({a, b}), edges_.insert({b, a}); }
    void cut(std::uint32_t a, std::uint32_t b) { edges_.erase({a, b}), edges_.erase({b, a}); }
    /// Removes all edges of a node.
    void isolate(std::uint32_t node) {
        std::erase_if(edges_, [&](const Edge& e) { return e.first == node || e.second == node; });
    }

    /// Sends a message of an application at `at`. @return number of the message, an index into
    /// `delivered`
    std::size_t send(std::uint32_t from, std::uint32_t to, Time at) {
        delivered.emplace_back();
        const std::size_t number = delivered.size() - 1;
        schedule(at, [this, from, to, number] {
            const MessageId id = add({.origin = NodeId{from},
                                      .number = static_cast<std::uint32_t>(number),
                                      .to = NodeId{to},
                                      .key = number,
                                      .size = 64,
                                      .created = now_,
                                      .payload = {},
                                      .is_routed = true});
            router_.send(*this, NodeId{from}, id);
            send_outbox();
            release(id);
        });
        return number;
    }
    /// Runs until `end`.
    void run(Time end) {
        while (!events_.empty() && events_.top().time <= end) {
            const Event event = events_.top();
            events_.pop();
            now_ = event.time;
            event.act();
            send_outbox();
            if (after_event) after_event();
        }
        now_ = std::max(now_, end);
    }

    Time now() const override { return now_; }
    std::size_t size() const override { return nodes_; }
    const Message& message(MessageId id) const override { return messages_[id]; }
    bool is_on(NodeId node) const override { return !off_.contains(node.value); }
    std::uint64_t key(NodeId node) const override {
        return node.index() < keys.size() ? keys[node.index()] : node.value;
    }
    Vec3 position(NodeId node) const override {
        return node.index() < positions.size() ? positions[node.index()] : Vec3{};
    }
    std::string_view role(NodeId node) const override {
        return node.index() < roles.size() ? roles[node.index()] : std::string_view{};
    }
    MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                        std::string content) override {
        return add({.origin = from,
                    .to = to,
                    .key = combine(key(from), packets_[from.value]++),
                    .size = bytes,
                    .created = now_,
                    .payload = std::move(content),
                    .kind = kind,
                    .is_routed = true});
    }
    std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                   Time at) override {
        if (at < now_) throw std::invalid_argument("a frame in the past");
        hold(frame);
        if (at == now_) {
            outbox_.push_back({frame, heard_from});
            return std::nullopt;
        }
        const auto handle = static_cast<SendHandle>(waiting_.size());
        waiting_.push_back(QueuedFrame{frame, heard_from});
        schedule(at, [this, handle] {
            if (const auto due = std::exchange(waiting_[handle], std::nullopt))
                outbox_.push_back(*due);
        });
        return handle;
    }
    QueuedFrame* waiting(SendHandle handle) override {
        return waiting_[handle] ? &*waiting_[handle] : nullptr;
    }
    void cancel(SendHandle handle) override {
        if (const auto frame = std::exchange(waiting_[handle], std::nullopt)) release(frame->frame);
    }
    /// Returns no frames: all frames leave immediately, so that none is queued.
    std::vector<QueuedFrame> take_queued(NodeId, NodeId) override { return {}; }
    void drop(NodeId, const Frame&, DropReason reason, std::string_view own_code = {}) override {
        ++drops[reason == DropReason::own ? own_code : reason_of(reason).code];
    }
    Dbm level(const Reception&) const override { return Dbm{-60}; }
    Db snr(const Reception& r) const override {
        return snr_between ? snr_between(arriving_from_, r.node) : Db{30};
    }
    void timer(NodeId node, Time at, std::uint64_t tag) override {
        schedule(at, [this, node, tag] { router_.on_timer(*this, node, tag); });
    }
    void hold(MessageId id) override { messages_.hold(id); }
    void release(MessageId id) override {
        if (messages_.release(id)) router_.forget(id);
    }
    void hold(const Frame& frame) override {
        hold(frame.message);
        if (frame.header != 0) ++headers_[frame.header];
    }
    void release(const Frame& frame) override {
        if (frame.header != 0 && --headers_[frame.header] == 0) router_.forget_header(frame.header);
        release(frame.message);
    }
    double draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const override {
        return uniform({.seed = seed,
                        .purpose = purpose,
                        .a = key(node),
                        .b = messages_[id].key,
                        .index = index});
    }
    double draw(Purpose purpose, NodeId node, std::uint64_t index) const override {
        return uniform({.seed = seed, .purpose = purpose, .a = key(node), .index = index});
    }

    /// Nodes to which each message of an application was delivered, with the number of hops.
    std::vector<std::vector<std::pair<NodeId, int>>> delivered{};
    /// Number of frames by kind of message; "" for messages of applications.
    std::map<std::string_view, int> frames{};
    /// Number of messages dropped by the protocol, by code of the reason.
    std::map<std::string_view, int> drops{};
    /// Number of messages in use.
    std::size_t messages_in_use() const { return messages_.size(); }
    /// Number of headers of frames in use.
    std::size_t headers_in_use() const {
        return static_cast<std::size_t>(std::count_if(
            headers_.begin(), headers_.end(), [](const auto& each) { return each.second > 0; }));
    }

  private:
    struct Event {
        Time time;
        std::uint64_t number;
        std::function<void()> act;
        bool operator<(const Event& other) const {
            return std::pair{other.time, other.number} < std::pair{time, number};
        }
    };

    void schedule(Time at, std::function<void()> act) {
        events_.push({at, next_event_++, std::move(act)});
    }
    MessageId add(Message message) {
        message.uid = next_uid_++;
        return messages_.add(std::move(message));
    }
    void send_outbox() {
        // outbox_ may grow in the loop
        for (std::size_t i = 0; i < outbox_.size(); ++i) transmit(outbox_[i]);
        outbox_.clear();
    }
    void transmit(const QueuedFrame& queued) {
        const Frame frame = queued.frame;
        if (!is_on(frame.sender)) {
            router_.on_sent(*this, queued, SendResult::off);
            release(frame);
            return;
        }
        ++frames[messages_[frame.message].kind];
        if (on_transmit) on_transmit(frame);
        const Duration more = faults.longest - hop_time;
        const Time end = now_ + hop_time + from_seconds(fault() * seconds(more));
        std::vector<Reception> receptions, overheard;
        const std::uint32_t sender = frame.sender.value;
        for (auto e = edges_.lower_bound({sender, 0}); e != edges_.end() && e->first == sender;
             ++e) {
            const NodeId to{e->second};
            const bool is_for = frame.next_hop == everyone || frame.next_hop == to;
            if (!is_for && !router_.traits().overhears) continue;
            if (fault() >= faults.loss) (is_for ? receptions : overheard).push_back({end, to});
        }
        schedule(end, [this, queued, receptions, overheard] {
            for (Reception each : overheard) {
                if (is_on(each.node)) router_.on_receive(*this, queued.frame, {&each, 1});
            }
            arrive(queued, receptions);
        });
    }
    void arrive(const QueuedFrame& queued, std::vector<Reception> receptions) {
        const Frame& frame = queued.frame;
        std::erase_if(receptions, [&](const Reception& r) { return !is_on(r.node); });
        const bool is_unnoticed = frame.next_hop != everyone && fault() < faults.unnoticed;
        const bool is_missed = frame.next_hop != everyone && (receptions.empty() || is_unnoticed);
        for (const Reception& r : receptions) {
            const Message& message = messages_[frame.message];
            if (on_message_at && message.kind.empty()) on_message_at(message, r.node);
        }
        arriving_from_ = frame.sender;
        if (!receptions.empty()) router_.on_receive(*this, frame, receptions);
        const Message message = messages_[frame.message];
        for (const Reception& r : receptions) {
            if (r.delivered && message.kind.empty())
                delivered[message.number].emplace_back(r.node, frame.hops);
            if (r.fate == Fate::ttl && message.kind.empty()) ++drops[reason_of(r.fate).code];
        }
        router_.on_sent(*this, queued,
                        is_missed                    ? SendResult::retries
                        : frame.next_hop != everyone ? SendResult::acked
                                                     : SendResult::sent);
        release(frame);
    }

    /// Random draw for a fault, in (0, 1).
    double fault() {
        return uniform({.seed = faults.seed,
                        .purpose = Purpose::bit_errors,
                        .a = 0,
                        .b = 0,
                        .index = next_fault_++});
    }

    std::size_t nodes_;
    Router router_;
    std::set<std::uint32_t> off_;
    std::uint64_t next_fault_ = 0;
    std::set<Edge> edges_;
    Time now_ = start_of_run;
    NodeId arriving_from_{};
    std::priority_queue<Event> events_;
    std::uint64_t next_event_ = 0, next_uid_ = 0;
    std::map<std::uint32_t, std::uint64_t> packets_;  // number of packets made by each node
    MessageTable messages_;
    std::vector<QueuedFrame> outbox_;
    std::vector<std::optional<QueuedFrame>> waiting_;
    std::map<std::uint32_t, int> headers_;
};

}  // namespace rovernet::test
