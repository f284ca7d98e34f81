// SPDX-License-Identifier: MIT
#pragma once

#include "sim/router.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::test {

/// Link layer for tests of a routing protocol: records the protocol's calls, and passes receptions
/// to the protocol when the test requests it. Nothing happens by itself.
class FakeLinkLayer final : public LinkLayer {
  public:
    /// State of a frame: waiting for its send time, in its sender's queue, or removed from the
    /// queue.
    enum class Stage { waiting, queued, gone };
    /// A frame that the protocol sent, by its SendHandle.
    struct Sending {
        QueuedFrame queued;
        Time at;
        Stage stage = Stage::waiting;
        std::uint64_t uid = 0;  ///< uid of the message, whose slot may be reused
    };
    struct Timer {
        NodeId node;
        Time at;
        std::uint64_t tag;
    };
    struct Drop {
        NodeId node;
        Frame frame;
        DropReason reason;
        std::string_view own_code = {};
    };

    explicit FakeLinkLayer(std::size_t nodes) : on(nodes, true), positions(nodes) {}

    /// Creates a message of an application.
    MessageId message_from(NodeId from, NodeId to = everyone, std::string payload = {}) {
        return add({.origin = from, .to = to, .payload = std::move(payload), .is_routed = true});
    }
    /// Passes a frame to the protocol, as received now at the given nodes. @return receptions after
    /// the protocol has set their fates
    template <class Protocol>
    std::vector<Reception> arrive(Protocol& protocol, const Frame& frame,
                                  std::initializer_list<std::uint32_t> nodes) {
        std::vector<Reception> receptions;
        for (const std::uint32_t node : nodes) receptions.push_back({time, NodeId{node}});
        protocol.on_receive(*this, frame, receptions);
        return receptions;
    }
    /// Advances to the send time of the last sent frame, which enters its sender's queue. @return
    /// the frame
    Frame go() {
        sent.back().stage = Stage::queued;
        time = sent.back().at;
        return sent.back().queued.frame;
    }
    /// Removes a frame from its queue, and reports the result to the protocol.
    template <class Protocol>
    void end(Protocol& protocol, std::size_t handle, SendResult result) {
        const QueuedFrame frame = sent[handle].queued;
        sent[handle].stage = Stage::gone;
        if constexpr (HearsOfResults<Protocol>) protocol.on_sent(*this, frame, result);
        release_reference(frame.frame);
    }

    Time now() const override { return time; }
    std::size_t size() const override { return on.size(); }
    const Message& message(MessageId id) const override { return messages[id]; }
    bool is_on(NodeId node) const override { return on[node.index()]; }
    std::uint64_t key(NodeId node) const override {
        return node.index() < keys.size() ? keys[node.index()] : node.value;
    }
    Vec3 position(NodeId node) const override { return positions[node.index()]; }
    std::string_view role(NodeId node) const override {
        return node.index() < roles.size() ? roles[node.index()] : std::string_view{};
    }
    MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                        std::string content) override {
        return add({.origin = from,
                    .to = to,
                    .size = bytes,
                    .payload = std::move(content),
                    .kind = kind,
                    .is_routed = true});
    }
    std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                   Time at) override {
        const bool is_control = !messages[frame.message].kind.empty();
        sent.push_back(
            {{frame, heard_from, is_control}, at, Stage::waiting, messages[frame.message].uid});
        messages.hold(frame.message);
        if (frame.header != 0) ++headers[frame.header];
        const auto handle = static_cast<SendHandle>(sent.size() - 1);
        if (at > time) return handle;
        sent.back().stage = Stage::queued;
        return std::nullopt;
    }
    QueuedFrame* waiting(SendHandle handle) override {
        return sent[handle].stage == Stage::waiting ? &sent[handle].queued : nullptr;
    }
    void cancel(SendHandle handle) override {
        if (!waiting(handle)) return;
        sent[handle].stage = Stage::gone;
        release_reference(sent[handle].queued.frame);
    }
    std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) override {
        std::vector<QueuedFrame> taken;
        for (Sending& each : sent) {
            const Frame& frame = each.queued.frame;
            if (each.stage != Stage::queued || frame.sender != node || frame.next_hop != next_hop)
                continue;
            each.stage = Stage::gone;
            taken.push_back(each.queued);
        }
        return taken;
    }
    void drop(NodeId node, const Frame& frame, DropReason reason,
              std::string_view own_code = {}) override {
        drops.push_back({node, frame, reason, own_code});
    }
    Dbm level(const Reception&) const override { return received_power; }
    Db snr(const Reception&) const override { return received_power - noise; }
    void timer(NodeId node, Time at, std::uint64_t tag) override {
        timers.push_back({node, at, tag});
    }
    void hold(MessageId id) override { messages.hold(id); }
    void release(MessageId id) override {
        if (messages.release(id) && on_forgotten) on_forgotten(id);
    }
    void hold(const Frame& frame) override {
        messages.hold(frame.message);
        if (frame.header != 0) ++headers[frame.header];
    }
    void release(const Frame& frame) override { release_reference(frame); }
    double draw(Purpose, NodeId, MessageId, std::uint64_t index) const override {
        return draw_of(index);
    }
    double draw(Purpose, NodeId, std::uint64_t index) const override { return draw_of(index); }

    Time time = start_of_run;
    std::vector<bool> on;
    std::vector<Vec3> positions;
    std::vector<std::string_view> roles{};
    /// keys of nodes; a node beyond the end has its id as its key
    std::vector<std::uint64_t> keys{};
    Dbm received_power{-60}, noise{-95};
    double drawn = 0.5;  ///< result of every random draw
    /// Results of the draws with these indices, in place of `drawn`.
    std::map<std::uint64_t, double> drawn_at{};
    MessageTable messages{};
    std::vector<Sending> sent{};
    std::vector<Timer> timers{};
    std::vector<Drop> drops{};
    std::map<std::uint32_t, int> headers{};  ///< number of references to each header of frames
    /// Functions of the protocol that are called after the last reference to a message or header
    /// was removed.
    std::function<void(MessageId)> on_forgotten{};
    std::function<void(std::uint32_t)> on_header_forgotten{};

  private:
    double draw_of(std::uint64_t index) const {
        const auto own = drawn_at.find(index);
        return own != drawn_at.end() ? own->second : drawn;
    }
    void release_reference(const Frame& frame) {
        if (frame.header != 0 && --headers[frame.header] == 0 && on_header_forgotten)
            on_header_forgotten(frame.header);
        release(frame.message);
    }
    MessageId add(Message message) {
        message.uid = next_uid_++;
        message.created = time;
        return messages.add(std::move(message));
    }
    std::uint64_t next_uid_ = 0;
};

}  // namespace rovernet::test
