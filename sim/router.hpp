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
// handle Router holds it by value. examples/router.cpp has a whole one:
//
//     struct Once {
//         Hops initial_ttl() const { return 1; }
//         void send(LinkLayer& link, NodeId node, MessageId message) {
//             link.send({.message = message, .sender = node, .ttl = 1, .hops = 1}, {}, link.now());
//         }
//         void on_receive(LinkLayer&, const Frame&, std::span<Reception> receptions) {
//             for (Reception& r : receptions) { r.fate = Fate::ttl; r.delivered = true; }
//         }
//     };
//     network.route(Once{});

namespace rovernet {

/// Routing protocol: one object for all its nodes, which calls the LinkLayer and is called by it.
///
/// It is told of nothing in the midst of its own functions: what it sends leaves once the function
/// has returned.
template <class T>
concept RouterProtocol = requires(T router, LinkLayer& link, NodeId node, MessageId message,
                                  const Frame& frame, std::span<Reception> receptions) {
    /// Takes a message that the node's application sends, for message.to or for everyone.
    {router.send(link, node, message)};
    /// Takes a frame that arrives at some of the nodes that it is for, in order of time and then of
    /// node; fills in each reception's fate, and whether the message is delivered there.
    {router.on_receive(link, frame, receptions)};
    /// TTL [hops] that a message of this router starts with, for records.
    { std::as_const(router).initial_ttl() } -> std::convertible_to<Hops>;
};

// Functions that a protocol may have beside these.

/// Protocol that sets timers by LinkLayer::timer. There is no way to take one back: on_timer looks
/// whether it is still wanted. `tag` is what it gave there.
template <class T>
concept HasTimers = requires(T router, LinkLayer& link, NodeId node, std::uint64_t tag) {
    {router.on_timer(link, node, tag)};
};
/// Protocol that keeps something of messages: of this one nothing is left, its slot of the table is
/// free for another.
template <class T>
concept ForgetsMessages = requires(T router, MessageId message) {
    {router.forget(message)};
};
/// Protocol that wants to know what became of its frames: each that was sent, and not taken back,
/// ends by one call. It is never told inside a call of its own to the link layer.
template <class T>
concept HearsOfResults = requires(T router, LinkLayer& link, const Frame& frame,
                                  SendResult result) {
    {router.on_sent(link, frame, result)};
};
/// Protocol whose nodes begin to work: each when the run begins, in the order of their keys, or
/// when it is added later. HELLO messages begin here.
template <class T>
concept HearsOfStarts = requires(T router, LinkLayer& link, NodeId node) {
    {router.on_start(link, node)};
};
/// Protocol that wants to know when a node is switched off or on. Frames that wait for their time,
/// and timers, stay: what a node that is off sends is dropped.
template <class T>
concept HearsOfSwitches = requires(T router, LinkLayer& link, NodeId node, bool on) {
    {router.on_switched(link, node, on)};
};
/// Traits of a protocol: static members that it may have, all false if it has none. The network
/// asks for them once, when the protocol is set.
struct RouterTraits {
    /// The protocol brings messages to one node, and not only to everyone: without it
    /// Network::send() refuses.
    bool routes_unicasts = false;
    /// Unicasts for others are in the span of on_receive, too; what it says of them is not
    /// recorded.
    bool overhears = false;
    /// The protocol asks LinkLayer::level, which costs a path loss for each reception.
    bool wants_levels = false;
};

/// Any routing protocol, held by value. Network::route takes one; a function that the protocol does
/// not have does nothing.
///
/// A Router is a handle with a table of functions, so that protocols need no base class; a call
/// costs one jump for all receptions of a frame together.
class Router {
  public:
    /// Moves the protocol in. Settings convert to their protocol: Router{Flood{.ttl = 3}}.
    template <class T>
    requires(!std::same_as<T, Router> && RouterProtocol<T>) Router(T protocol)
        : traits_(traits_of<T>()),
          hears_of_results_(HearsOfResults<T>),
          hears_of_starts_(HearsOfStarts<T>),
          self_(std::make_unique<Holder<T>>(std::move(protocol))) {}

    /// Facts about the protocol, asked before it is told of things that it may not want.
    const RouterTraits& traits() const { return traits_; }
    /// Whether on_sent and on_start do anything: the network need not look for what to tell.
    bool hears_of_results() const { return hears_of_results_; }
    bool hears_of_starts() const { return hears_of_starts_; }
    /// Calls of the protocol.
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
    /// TTL that a message starts with [hops].
    Hops initial_ttl() const { return self_->initial_ttl(); }

  private:
    // Traits by the members that the protocol has.
    template <class T>
    static constexpr RouterTraits traits_of() {
        RouterTraits traits;
        if constexpr (requires { T::routes_unicasts; }) traits.routes_unicasts = T::routes_unicasts;
        if constexpr (requires { T::overhears; }) traits.overhears = T::overhears;
        if constexpr (requires { T::wants_levels; }) traits.wants_levels = T::wants_levels;
        return traits;
    }

    // Functions of a protocol, whatever its type.
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
    // Protocol of a type, with the functions that it lacks.
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
    // Facts about the protocol, and the protocol itself, on the heap: a Router moves without it.
    RouterTraits traits_;
    bool hears_of_results_, hears_of_starts_;
    // Never null, but in a Router that was moved from.
    std::unique_ptr<Concept> self_;
};

}  // namespace rovernet
