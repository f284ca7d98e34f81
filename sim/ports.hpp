// SPDX-License-Identifier: MIT
#pragma once

#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/random.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <concepts>
#include <memory>
#include <optional>
#include <span>
#include <utility>

// The ports through which the siblings of one floor meet. A user's router or sink is a plain
// struct that satisfies the concept; the handles below hold it by value.

namespace rovernet {

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
    /// Puts `frame` on air from frame.sender now, which must be on. `heard_from`: who the sender
    /// received it from; nothing if it originates the frame.
    virtual void broadcast(const Frame& frame, std::optional<NodeId> heard_from) = 0;
    /// Puts `frame` on air for frame.next_hop, as broadcast() does; the router is told of its end
    /// by on_sent, if it has that.
    virtual void unicast(const Frame& frame, std::optional<NodeId> heard_from) = 0;
    /// Records that `node` loses a copy, `frame` as received.
    virtual void drop(NodeId node, const Frame& frame, DropReason reason) = 0;
    /// Calls the router's on_timer(node, tag) at `at`; in answer to a reception that is at least
    /// `least_reaction` after it.
    virtual void timer(NodeId node, Time at, std::uint64_t tag) = 0;
    /// Keeps a message in the table while the router holds a copy of it.
    virtual void hold(MessageId) = 0;
    virtual void release(MessageId) = 0;
    /// A uniform draw in (0, 1), keyed by the run, the purpose, the node, the message and `index`.
    virtual double draw(Purpose, NodeId, MessageId, std::uint64_t index) const = 0;

  protected:
    ~LinkLayer() = default;
};

/// No node reacts to a reception faster than this, which is what lets one event stand for all the
/// receptions of a transmission.
inline constexpr Duration least_reaction{1000};

/// A routing protocol: one object for all its nodes.
template <class T>
concept RouterProtocol = requires(T router, LinkLayer& link, NodeId node, MessageId message,
                                  const Frame& frame, std::span<Reception> receptions,
                                  std::uint64_t tag) {
    /// The node's application sends a message.
    {router.send(link, node, message)};
    /// The frame arrives at some of its receivers, in order of time and then of node; fills each
    /// reception's fate and delivery.
    {router.on_receive(link, frame, receptions)};
    {router.on_timer(link, node, tag)};
    /// A slot of the message table is free for another message.
    {router.forget(message)};
    /// TTL that a message of this router starts with [hops].
    { std::as_const(router).initial_ttl() } -> std::convertible_to<Hops>;
};

/// A protocol that wants to know whether a unicast of its was acknowledged.
template <class T>
concept TellsOfUnicasts = requires(T router, LinkLayer& link, const Frame& frame, bool received) {
    {router.on_sent(link, frame, received)};
};

/// Any routing protocol, held by value.
class Router {
  public:
    template <class T>
    requires(!std::same_as<T, Router> && RouterProtocol<T>) Router(T protocol)
        : self_(std::make_unique<Holder<T>>(std::move(protocol))) {}

    void send(LinkLayer& link, NodeId node, MessageId m) { self_->send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& f, std::span<Reception> r) {
        self_->on_receive(link, f, r);
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        self_->on_timer(link, node, tag);
    }
    void on_sent(LinkLayer& link, const Frame& frame, bool received) {
        self_->on_sent(link, frame, received);
    }
    void forget(MessageId m) { self_->forget(m); }
    Hops initial_ttl() const { return self_->initial_ttl(); }

  private:
    struct Concept {
        virtual ~Concept() = default;
        virtual void send(LinkLayer&, NodeId, MessageId) = 0;
        virtual void on_receive(LinkLayer&, const Frame&, std::span<Reception>) = 0;
        virtual void on_timer(LinkLayer&, NodeId, std::uint64_t) = 0;
        virtual void on_sent(LinkLayer&, const Frame&, bool) = 0;
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
        void on_timer(LinkLayer& l, NodeId n, std::uint64_t t) override {
            protocol.on_timer(l, n, t);
        }
        void on_sent(LinkLayer& l, const Frame& f, bool received) override {
            if constexpr (TellsOfUnicasts<T>) protocol.on_sent(l, f, received);
        }
        void forget(MessageId m) override { protocol.forget(m); }
        Hops initial_ttl() const override { return protocol.initial_ttl(); }
        T protocol;
    };
    std::unique_ptr<Concept> self_;
};

/// An observer of records: says once which kinds it wants, then gets each of them in order.
template <class T>
concept RecordSink = requires(T sink, const Record& record, const RecordContext& context) {
    { std::as_const(sink).kinds() } -> std::convertible_to<KindMask>;
    {sink.on(record, context)};
};

/// Any sink, shared: the caller may keep a handle to ask it for its result.
class Sink {
  public:
    template <RecordSink T>
    Sink(std::shared_ptr<T> sink)
        : kinds_(sink->kinds()),
          on_([](void* p, const Record& r, const RecordContext& c) {
              static_cast<T*>(p)->on(r, c);
          }),
          self_(std::move(sink)) {}
    template <RecordSink T>
    Sink(T sink) : Sink(std::make_shared<T>(std::move(sink))) {}

    KindMask kinds() const { return kinds_; }
    void on(const Record& record, const RecordContext& context) {
        on_(self_.get(), record, context);
    }

  private:
    KindMask kinds_;
    void (*on_)(void*, const Record&, const RecordContext&);
    std::shared_ptr<void> self_;
};

}  // namespace rovernet
