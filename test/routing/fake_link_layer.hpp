// SPDX-License-Identifier: MIT
#pragma once

#include "sim/router.hpp"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::test {

/// A link layer for tests of a protocol: keeps what the protocol does, and hands it receptions that
/// the test makes up. Nothing happens by itself.
class FakeLinkLayer final : public LinkLayer {
  public:
    /// A frame that the protocol sent, by its SendHandle.
    struct Sending {
        QueuedFrame queued;
        Time at;
        bool is_waiting = true;
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
    };

    explicit FakeLinkLayer(std::size_t nodes) : on(nodes, true), positions(nodes) {}

    /// A message of an application.
    MessageId message_from(NodeId from, NodeId to = everyone, std::string payload = {}) {
        return add({.origin = from, .to = to, .payload = std::move(payload), .is_routed = true});
    }
    /// The frame arrives at these nodes now. @return what the protocol made of it
    template <class Protocol>
    std::vector<Reception> arrive(Protocol& protocol, const Frame& frame,
                                  std::initializer_list<std::uint32_t> nodes) {
        std::vector<Reception> receptions;
        for (const std::uint32_t node : nodes) receptions.push_back({time, NodeId{node}});
        protocol.on_receive(*this, frame, receptions);
        return receptions;
    }
    /// The time of the last frame that was sent has come. @return it
    Frame go() {
        sent.back().is_waiting = false;
        time = sent.back().at;
        return sent.back().queued.frame;
    }

    Time now() const override { return time; }
    std::size_t size() const override { return on.size(); }
    const Message& message(MessageId id) const override { return messages[id]; }
    bool is_on(NodeId node) const override { return on[node.index()]; }
    std::uint64_t key(NodeId node) const override { return node.value; }
    Vec3 position(NodeId node) const override { return positions[node.index()]; }
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
        sent.push_back({{frame, heard_from}, at});
        messages.hold(frame.message);
        return static_cast<SendHandle>(sent.size() - 1);
    }
    QueuedFrame* waiting(SendHandle handle) override {
        return sent[handle].is_waiting ? &sent[handle].queued : nullptr;
    }
    void cancel(SendHandle handle) override { sent[handle].is_waiting = false; }
    std::vector<QueuedFrame> take_queued(NodeId, NodeId) override { return {}; }
    void drop(NodeId node, const Frame& frame, DropReason reason) override {
        drops.push_back({node, frame, reason});
    }
    Dbm level(const Reception&) const override { return received_power; }
    void timer(NodeId node, Time at, std::uint64_t tag) override {
        timers.push_back({node, at, tag});
    }
    void hold(MessageId id) override { messages.hold(id); }
    void release(MessageId id) override { messages.release(id); }
    double draw(Purpose, NodeId, MessageId, std::uint64_t) const override { return drawn; }
    double draw(Purpose, NodeId, std::uint64_t) const override { return drawn; }

    Time time = start_of_run;
    std::vector<bool> on;
    std::vector<Vec3> positions;
    Dbm received_power{-60};
    double drawn = 0.5;  ///< by every draw
    MessageTable messages{};
    std::vector<Sending> sent{};
    std::vector<Timer> timers{};
    std::vector<Drop> drops{};

  private:
    MessageId add(Message message) {
        message.uid = next_uid_++;
        return messages.add(std::move(message));
    }
    std::uint64_t next_uid_ = 0;
};

}  // namespace rovernet::test
