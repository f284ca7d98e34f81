// SPDX-License-Identifier: MIT
#pragma once

#include "sim/routing_protocol.hpp"

#include <concepts>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace rovernet {

/// Routing protocol of any type, stored by value. Network::route takes a Router; calls of optional
/// functions that the protocol does not have do nothing.
///
/// A Router has a table of functions, so protocols need no base class; one virtual call handles all
/// receptions of a frame.
class Router {
  public:
    /// Stores the protocol. Settings convert to their protocol: Router{Flood{.ttl = 3}}.
    template <class T>
    requires(!std::same_as<T, Router> && RouterProtocol<T>) Router(T protocol)
        : traits_(traits_of(protocol)),
          hears_of_results_(hears_of_results_of(protocol)),
          hears_of_starts_(HearsOfStarts<T>),
          has_routes_(HasRoutes<T>),
          self_(std::make_unique<Holder<T>>(std::move(protocol))) {}

    /// Traits of the routing protocol.
    const RouterTraits& traits() const { return traits_; }
    /// Whether the protocol has the optional function on_sent (hears_of_results) or on_start
    /// (hears_of_starts). The network skips the work for a missing function.
    bool hears_of_results() const { return hears_of_results_; }
    bool hears_of_starts() const { return hears_of_starts_; }
    /// Whether the protocol has routing tables to show.
    bool has_routes() const { return has_routes_; }
    /// Calls of the protocol's functions of the same names.
    void send(LinkLayer& link, NodeId node, MessageId m) { self_->send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& f, std::span<Reception> r) {
        self_->on_receive(link, f, r);
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        self_->on_timer(link, node, tag);
    }
    void on_sent(LinkLayer& link, const QueuedFrame& frame, SendResult result) {
        self_->on_sent(link, frame, result);
    }
    void on_start(LinkLayer& link, NodeId node) { self_->on_start(link, node); }
    void on_switched(LinkLayer& link, NodeId node, bool on) { self_->on_switched(link, node, on); }
    void forget(MessageId m) { self_->forget(m); }
    void forget_header(std::uint32_t header) { self_->forget_header(header); }
    bool keeps(MessageId m) const { return self_->keeps(m); }
    void describe(const Message& m, const Frame& f, PacketStyle style, std::string& text) const {
        self_->describe(m, f, style, text);
    }
    /// Header of a frame with Frame::header; without bytes if the protocol does not show it.
    FrameHeader header_bytes(const Frame& f) const { return self_->header_bytes(f); }
    /// Routing table of a node at `now`, in the order of destinations; empty if the protocol has
    /// none.
    std::vector<RouteState> routes(NodeId node, Time now) const { return self_->routes(node, now); }
    /// Notice of the protocol to the user at the end of a run; empty if there is none.
    std::string notice() const { return self_->notice(); }
    /// Initial TTL of a message [hops].
    Hops initial_ttl(const Message& m) const { return self_->initial_ttl(m); }

  private:
    // Whether the protocol has on_sent. A protocol that contains another protocol states this by
    // its function hears_of_results().
    template <class T>
    static bool hears_of_results_of(const T& protocol) {
        if constexpr (requires { protocol.hears_of_results(); }) return protocol.hears_of_results();
        return HearsOfResults<T>;
    }
    // Traits of a protocol, from its static members. A protocol that contains another protocol
    // states its traits by its function traits().
    template <class T>
    static RouterTraits traits_of(const T& protocol) {
        if constexpr (requires { protocol.traits(); }) return protocol.traits();
        RouterTraits traits;
        if constexpr (requires { T::routes_unicasts; }) traits.routes_unicasts = T::routes_unicasts;
        if constexpr (requires { T::overhears; }) traits.overhears = T::overhears;
        if constexpr (requires { T::wants_levels; }) traits.wants_levels = T::wants_levels;
        if constexpr (requires { T::roles; }) traits.roles = T::roles;
        return traits;
    }

    // Interface to the functions of a protocol of any type.
    struct Concept {
        virtual ~Concept() = default;
        virtual void send(LinkLayer&, NodeId, MessageId) = 0;
        virtual void on_receive(LinkLayer&, const Frame&, std::span<Reception>) = 0;
        virtual void on_timer(LinkLayer&, NodeId, std::uint64_t) = 0;
        virtual void on_sent(LinkLayer&, const QueuedFrame&, SendResult) = 0;
        virtual void on_start(LinkLayer&, NodeId) = 0;
        virtual void on_switched(LinkLayer&, NodeId, bool) = 0;
        virtual void forget(MessageId) = 0;
        virtual void forget_header(std::uint32_t) = 0;
        virtual bool keeps(MessageId) const = 0;
        virtual void describe(const Message&, const Frame&, PacketStyle, std::string&) const = 0;
        virtual FrameHeader header_bytes(const Frame&) const = 0;
        virtual std::vector<RouteState> routes(NodeId, Time) const = 0;
        virtual std::string notice() const = 0;
        virtual Hops initial_ttl(const Message&) const = 0;
    };
    // Protocol of type T; functions that T lacks do nothing.
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
        void on_sent([[maybe_unused]] LinkLayer& l, [[maybe_unused]] const QueuedFrame& f,
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
        void forget_header([[maybe_unused]] std::uint32_t header) override {
            if constexpr (ForgetsHeaders<T>) protocol.forget_header(header);
        }
        bool keeps([[maybe_unused]] MessageId m) const override {
            if constexpr (KeepsMessages<T>) return protocol.keeps(m);
            return false;
        }
        void describe([[maybe_unused]] const Message& m, [[maybe_unused]] const Frame& f,
                      [[maybe_unused]] PacketStyle style,
                      [[maybe_unused]] std::string& text) const override {
            if constexpr (DescribesPackets<T>) protocol.describe(m, f, style, text);
        }
        FrameHeader header_bytes([[maybe_unused]] const Frame& f) const override {
            if constexpr (ShowsHeaders<T>) return protocol.header_bytes(f);
            return {};
        }
        std::vector<RouteState> routes([[maybe_unused]] NodeId node,
                                       [[maybe_unused]] Time now) const override {
            if constexpr (HasRoutes<T>) return protocol.routes(node, now);
            return {};
        }
        std::string notice() const override {
            if constexpr (HasNotice<T>) return protocol.notice();
            return {};
        }
        Hops initial_ttl([[maybe_unused]] const Message& m) const override {
            if constexpr (HasOwnTtls<T>) return protocol.initial_ttl(m);
            return protocol.initial_ttl();
        }
        T protocol;
    };
    // Traits and optional functions of the protocol. The protocol itself is on the heap, so that
    // moving a Router does not move it.
    RouterTraits traits_;
    bool hears_of_results_, hears_of_starts_, has_routes_;
    // Routing protocol; never null, except in a moved-from Router.
    std::unique_ptr<Concept> self_;
};

}  // namespace rovernet
