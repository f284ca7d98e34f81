// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/link_layer.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

// The port of routing protocols. A protocol is a plain struct that satisfies RouterProtocol; the
// handle Router holds it by value.

namespace rovernet {

/// A routing protocol: one object for all its nodes.
template <class T>
concept RouterProtocol = requires(T router, LinkLayer& link, NodeId node, MessageId message,
                                  const Frame& frame, std::span<Reception> receptions) {
    /// The node's application sends a message, for message.to or for everyone.
    {router.send(link, node, message)};
    /// The frame arrives at some of those that it is for, in order of time and then of node; fills
    /// each reception's fate and delivery.
    {router.on_receive(link, frame, receptions)};
    /// TTL that a message of this router starts with [hops].
    { std::as_const(router).initial_ttl() } -> std::convertible_to<Hops>;
};

// What a protocol may have beside that.

/// A protocol that sets timers.
template <class T>
concept HasTimers = requires(T router, LinkLayer& link, NodeId node, std::uint64_t tag) {
    {router.on_timer(link, node, tag)};
};
/// A protocol that keeps something of messages: of this one nothing is left, its slot of the table
/// is free for another.
template <class T>
concept ForgetsMessages = requires(T router, MessageId message) {
    {router.forget(message)};
};
/// A protocol that wants to know what became of its frames. It is never told inside a call of its
/// own to the link layer.
template <class T>
concept HearsOfResults = requires(T router, LinkLayer& link, const Frame& frame,
                                  SendResult result) {
    {router.on_sent(link, frame, result)};
};
/// A protocol whose nodes begin to work: each when the run begins, or when it is added later.
template <class T>
concept HearsOfStarts = requires(T router, LinkLayer& link, NodeId node) {
    {router.on_start(link, node)};
};
/// A protocol that wants to know when a node is switched off or on.
template <class T>
concept HearsOfSwitches = requires(T router, LinkLayer& link, NodeId node, bool on) {
    {router.on_switched(link, node, on)};
};
/// Static members that a protocol may have beside RouterProtocol, all false if it has none.
struct RouterTraits {
    /// It brings messages to one node, and not only to everyone.
    bool routes_unicasts = false;
    /// Unicasts for others are in the span of on_receive, too; what it says of them is not
    /// recorded.
    bool overhears = false;
    /// It asks LinkLayer::level.
    bool wants_levels = false;
};

/// Any routing protocol, held by value.
class Router {
  public:
    template <class T>
    requires(!std::same_as<T, Router> && RouterProtocol<T>) Router(T protocol)
        : traits_(traits_of<T>()),
          hears_of_results_(HearsOfResults<T>),
          hears_of_starts_(HearsOfStarts<T>),
          self_(std::make_unique<Holder<T>>(std::move(protocol))) {}

    const RouterTraits& traits() const { return traits_; }
    bool hears_of_results() const { return hears_of_results_; }
    bool hears_of_starts() const { return hears_of_starts_; }
    void send(LinkLayer& link, NodeId node, MessageId m) { self_->send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& f, std::span<Reception> r) {
        self_->on_receive(link, f, r);
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        self_->on_timer(link, node, tag);
    }
    void on_sent(LinkLayer& link, const Frame& frame, SendResult result) {
        self_->on_sent(link, frame, result);
    }
    void on_start(LinkLayer& link, NodeId node) { self_->on_start(link, node); }
    void on_switched(LinkLayer& link, NodeId node, bool on) { self_->on_switched(link, node, on); }
    void forget(MessageId m) { self_->forget(m); }
    Hops initial_ttl() const { return self_->initial_ttl(); }

  private:
    template <class T>
    static constexpr RouterTraits traits_of() {
        RouterTraits traits;
        if constexpr (requires { T::routes_unicasts; }) traits.routes_unicasts = T::routes_unicasts;
        if constexpr (requires { T::overhears; }) traits.overhears = T::overhears;
        if constexpr (requires { T::wants_levels; }) traits.wants_levels = T::wants_levels;
        return traits;
    }

    struct Concept {
        virtual ~Concept() = default;
        virtual void send(LinkLayer&, NodeId, MessageId) = 0;
        virtual void on_receive(LinkLayer&, const Frame&, std::span<Reception>) = 0;
        virtual void on_timer(LinkLayer&, NodeId, std::uint64_t) = 0;
        virtual void on_sent(LinkLayer&, const Frame&, SendResult) = 0;
        virtual void on_start(LinkLayer&, NodeId) = 0;
        virtual void on_switched(LinkLayer&, NodeId, bool) = 0;
        virtual void forget(MessageId) = 0;
        virtual Hops initial_ttl() const = 0;
    };
    template <class T>
    struct Holder final : Concept {
        explicit Holder(T p) : protocol(std::move(p)) {}
        void send(LinkLayer& l, NodeId n, MessageId m) override { protocol.send(l, n, m); }
        void on_receive(LinkLayer& l, const Frame& f, std::span<Reception> r) override {
            protocol.on_receive(l, f, r);
        }
        void on_timer([[maybe_unused]] LinkLayer& l, [[maybe_unused]] NodeId n,
                      [[maybe_unused]] std::uint64_t tag) override {
            if constexpr (HasTimers<T>) protocol.on_timer(l, n, tag);
        }
        void on_sent([[maybe_unused]] LinkLayer& l, [[maybe_unused]] const Frame& f,
                     [[maybe_unused]] SendResult result) override {
            if constexpr (HearsOfResults<T>) protocol.on_sent(l, f, result);
        }
        void on_start([[maybe_unused]] LinkLayer& l, [[maybe_unused]] NodeId n) override {
            if constexpr (HearsOfStarts<T>) protocol.on_start(l, n);
        }
        void on_switched([[maybe_unused]] LinkLayer& l, [[maybe_unused]] NodeId n,
                         [[maybe_unused]] bool on) override {
            if constexpr (HearsOfSwitches<T>) protocol.on_switched(l, n, on);
        }
        void forget([[maybe_unused]] MessageId m) override {
            if constexpr (ForgetsMessages<T>) protocol.forget(m);
        }
        Hops initial_ttl() const override { return protocol.initial_ttl(); }
        T protocol;
    };
    RouterTraits traits_;
    bool hears_of_results_, hears_of_starts_;
    std::unique_ptr<Concept> self_;
};

}  // namespace rovernet
