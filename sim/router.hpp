// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/random.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The port of routing protocols. A protocol is a plain struct that satisfies RouterProtocol; the
// handle Router holds it by value.

namespace rovernet {

/// No node reacts to a reception faster than this, which is what lets one event stand for all the
/// receptions of a transmission.
inline constexpr Duration least_reaction{1000};

/// A frame that waits for its time, see LinkLayer::waiting.
using SendHandle = std::uint32_t;

/// What became of a frame that a router sent.
enum class SendResult : std::uint8_t {
    acked,       ///< its next hop acknowledged it
    sent,        ///< it was on air; whether anybody got it is not known
    retries,     ///< no acknowledgement came, however often it was sent
    queue_full,  ///< its sender's queue had no room for it
    off,         ///< its sender was switched off before it was on air
};

/// What a router may do. Implemented by the Network; users only call it.
class LinkLayer {
  public:
    virtual Time now() const = 0;
    /// Nodes so far; their ids are 0 ... size - 1.
    virtual std::size_t size() const = 0;
    virtual const Message& message(MessageId) const = 0;
    virtual bool is_on(NodeId) const = 0;
    /// The node's key, for keys of random draws; unlike its id it does not depend on other nodes.
    virtual std::uint64_t key(NodeId) const = 0;
    /// [m] Where the node is now.
    virtual Vec3 position(NodeId) const = 0;

    /// Makes a packet of the protocol's own, held once by the caller; no application is told of it.
    /// @param kind     what its records call it, a literal: "rreq"
    /// @param bytes    [bytes] on air
    /// @param content  what it says
    virtual MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                                std::string content) = 0;
    /// Puts a frame on air from frame.sender at `at`, for frame.next_hop or for everyone. Now means
    /// as soon as the router's own function has returned; in answer to a reception it is at least
    /// `least_reaction` after that. If the sender is off by then, a Dropped says so.
    /// @param heard_from  who the sender received it from; nothing if it originates the frame
    /// @return a handle until then; nothing if that is now
    /// @throws std::invalid_argument if `at` is too early
    virtual std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                           Time at) = 0;
    /// A frame that waits for its time: it may be changed, but for its message and its sender.
    /// Null once its time has come. Later the handle may be another frame's: compare message and
    /// sender.
    virtual QueuedFrame* waiting(SendHandle) = 0;
    /// Takes back a frame that waits for its time.
    virtual void cancel(SendHandle) = 0;
    /// Takes the frames for `next_hop` out of the queue in which `node` waits for access, but for
    /// one that is being sent. The caller holds their messages now.
    virtual std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) = 0;
    /// Records that `node` loses a copy, `frame` as received.
    virtual void drop(NodeId node, const Frame& frame, DropReason reason) = 0;
    /// [dBm] Received power of a reception that on_receive was given, while that runs; for
    /// protocols with `wants_levels`.
    virtual Dbm level(const Reception&) const = 0;

    /// Calls the router's on_timer(node, tag) at `at`; in answer to a reception that is at least
    /// `least_reaction` after it. There is no way back: look at `now` and a deadline of your own.
    virtual void timer(NodeId node, Time at, std::uint64_t tag) = 0;
    /// Keeps a message in the table while the router holds a copy of it.
    virtual void hold(MessageId) = 0;
    virtual void release(MessageId) = 0;
    /// A uniform draw in (0, 1), keyed by the run, the purpose, the node, the message and `index`.
    virtual double draw(Purpose, NodeId, MessageId, std::uint64_t index) const = 0;
    /// The node's `index`-th uniform draw in (0, 1) for this purpose, of no message.
    virtual double draw(Purpose, NodeId, std::uint64_t index) const = 0;

  protected:
    ~LinkLayer() = default;
};

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
