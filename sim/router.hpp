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

// Interface of routing protocols. A protocol is a plain struct that satisfies RouterProtocol; the
// handle Router stores it by value. A complete one is in examples/router.cpp:
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
/// Callbacks never occur inside the protocol's own functions: frames that a function sends leave
/// after it has returned.
template <class T>
concept RouterProtocol = requires(T router, LinkLayer& link, NodeId node, MessageId message,
                                  const Frame& frame, std::span<Reception> receptions) {
    /// Called for a message that the node's application sends, to message.to or to everyone.
    {router.send(link, node, message)};
    /// Called for a frame at some of its destination nodes, in order of time and then of node; it
    /// sets each reception's fate, and whether the message is delivered there.
    {router.on_receive(link, frame, receptions)};
    /// Initial TTL [hops] of messages of this router, for records.
    { std::as_const(router).initial_ttl() } -> std::convertible_to<Hops>;
};

// Optional functions of a protocol.

/// Protocol with timers, set by LinkLayer::timer. A timer cannot be cancelled: on_timer checks
/// whether it is still wanted. `tag` is the value passed to LinkLayer::timer.
template <class T>
concept HasTimers = requires(T router, LinkLayer& link, NodeId node, std::uint64_t tag) {
    {router.on_timer(link, node, tag)};
};
/// Protocol that stores data of messages: forget() is called when a message is gone and its slot of
/// the table is free.
template <class T>
concept ForgetsMessages = requires(T router, MessageId message) {
    {router.forget(message)};
};
/// Protocol that is notified of the results of its frames: every frame that was sent and not
/// cancelled causes one call. The call never occurs inside a call of the protocol to the link
/// layer.
template <class T>
concept HearsOfResults = requires(T router, LinkLayer& link, const Frame& frame,
                                  SendResult result) {
    {router.on_sent(link, frame, result)};
};
/// Protocol that is notified of node starts: on_start is called for each node when the run begins,
/// in the order of keys, or when the node is added later. HELLO messages start here.
template <class T>
concept HearsOfStarts = requires(T router, LinkLayer& link, NodeId node) {
    {router.on_start(link, node)};
};
/// Protocol that is notified when a node is switched off or on. Frames that wait for their send
/// time, and timers, remain; a frame from a node that is off is dropped.
template <class T>
concept HearsOfSwitches = requires(T router, LinkLayer& link, NodeId node, bool on) {
    {router.on_switched(link, node, on)};
};
/// Protocol whose messages have different initial TTLs.
template <class T>
concept HasOwnTtls = requires(const T router, const Message& message) {
    { router.initial_ttl(message) } -> std::convertible_to<Hops>;
};
/// Traits of a protocol: optional static members, false by default. The network reads them once,
/// when the protocol is set.
struct RouterTraits {
    /// The protocol routes messages to one node, not only to everyone; Network::send() throws
    /// otherwise.
    bool routes_unicasts = false;
    /// on_receive also gets unicasts for other nodes; the fates that it sets for them are not
    /// recorded.
    bool overhears = false;
    /// The protocol calls LinkLayer::level, which computes a path loss for each reception.
    bool wants_levels = false;
};

/// Routing protocol of any type, stored by value. Network::route takes one; calls of optional
/// functions that the protocol does not have do nothing.
///
/// A Router has a table of functions, so protocols need no base class; one virtual call handles all
/// receptions of a frame.
class Router {
  public:
    /// Stores the protocol. Settings convert to their protocol: Router{Flood{.ttl = 3}}.
    template <class T>
    requires(!std::same_as<T, Router> && RouterProtocol<T>) Router(T protocol)
        : traits_(traits_of<T>()),
          hears_of_results_(HearsOfResults<T>),
          hears_of_starts_(HearsOfStarts<T>),
          self_(std::make_unique<Holder<T>>(std::move(protocol))) {}

    /// Traits of the protocol.
    const RouterTraits& traits() const { return traits_; }
    /// Whether the protocol has on_sent and on_start; the network skips the work for them
    /// otherwise.
    bool hears_of_results() const { return hears_of_results_; }
    bool hears_of_starts() const { return hears_of_starts_; }
    /// Calls the protocol's function of the same name.
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
    /// Initial TTL of a message [hops].
    Hops initial_ttl(const Message& m) const { return self_->initial_ttl(m); }

  private:
    // Traits from the static members of the protocol.
    template <class T>
    static constexpr RouterTraits traits_of() {
        RouterTraits traits;
        if constexpr (requires { T::routes_unicasts; }) traits.routes_unicasts = T::routes_unicasts;
        if constexpr (requires { T::overhears; }) traits.overhears = T::overhears;
        if constexpr (requires { T::wants_levels; }) traits.wants_levels = T::wants_levels;
        return traits;
    }

    // Functions of a protocol of any type.
    struct Concept {
        virtual ~Concept() = default;
        virtual void send(LinkLayer&, NodeId, MessageId) = 0;
        virtual void on_receive(LinkLayer&, const Frame&, std::span<Reception>) = 0;
        virtual void on_timer(LinkLayer&, NodeId, std::uint64_t) = 0;
        virtual void on_sent(LinkLayer&, const Frame&, SendResult) = 0;
        virtual void on_start(LinkLayer&, NodeId) = 0;
        virtual void on_switched(LinkLayer&, NodeId, bool) = 0;
        virtual void forget(MessageId) = 0;
        virtual Hops initial_ttl(const Message&) const = 0;
    };
    // Protocol of type T; functions that it lacks do nothing.
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
        Hops initial_ttl([[maybe_unused]] const Message& m) const override {
            if constexpr (HasOwnTtls<T>) return protocol.initial_ttl(m);
            return protocol.initial_ttl();
        }
        T protocol;
    };
    // Facts about the protocol. The protocol itself is on the heap, so that moving a Router does
    // not move it.
    RouterTraits traits_;
    bool hears_of_results_, hears_of_starts_;
    // Never null, except in a moved-from Router.
    std::unique_ptr<Concept> self_;
};

}  // namespace rovernet
