// SPDX-License-Identifier: MIT
#pragma once

#include "network/mac.hpp"
#include "sim/router.hpp"
#include "sim/slots.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

struct World;

/// What the routing layer tells the applications.
class RoutingUser {
  public:
    /// Receptions of which some are delivered: their nodes have the message now.
    virtual void delivered(const Frame& frame, std::span<const Reception> receptions) = 0;
    /// The node's queue has room for one frame more.
    virtual void has_room(NodeId node) = 0;

  protected:
    ~RoutingUser() = default;
};

/// Gets messages over their hops: the routing protocol, and the link layer that it works on.
class Routing final : public LinkLayer, public MacUser {
  public:
    Routing(World& world, Mac& mac, RoutingUser& user) : world_(world), mac_(mac), user_(user) {}

    /// @throws std::invalid_argument if there is a protocol
    void set(Router router);
    const std::optional<Router>& router() const { return router_; }
    /// A node's application sends a message: by the protocol, or over one hop without.
    void originate(NodeId node, MessageId message);
    void send_one_hop(const Frame& frame);
    // Events.
    void on_timer(NodeId node, std::uint64_t tag);
    void on_send(SendHandle handle);
    /// The run begins.
    void start();
    // A node is added later, or switched.
    void on_start(NodeId node);
    void on_switched(NodeId node, bool on);

    // LinkLayer, for the router.
    Time now() const override;
    std::size_t size() const override;
    const Message& message(MessageId id) const override;
    bool is_on(NodeId node) const override;
    std::uint64_t key(NodeId node) const override;
    Vec3 position(NodeId node) const override;
    MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                        std::string content) override;
    std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                   Time at) override;
    QueuedFrame* waiting(SendHandle handle) override;
    void cancel(SendHandle handle) override;
    std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) override;
    void drop(NodeId node, const Frame& frame, DropReason reason) override;
    Dbm level(const Reception& reception) const override;
    void timer(NodeId node, Time at, std::uint64_t tag) override;
    void hold(MessageId id) override;
    void release(MessageId id) override;
    double draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const override;
    double draw(Purpose purpose, NodeId node, std::uint64_t index) const override;

    // MacUser.
    void arrived(const AirFrame& frame, const Arriving& part) override;
    void sent(const QueuedFrame& frame) override;
    void lost(const QueuedFrame& frame, DropReason reason) override;

  private:
    template <class Call>
    void call_router(Call call);
    void send_now(const QueuedFrame& frame);
    void tell(const Frame& frame, SendResult result);
    void hand_up(const Frame& frame, std::span<Reception> receptions, std::span<const Dbm> levels);
    void hand_up_heard(const Frame& frame, const Arriving& part);
    void receive_broadcast(const AirFrame& air, const Arriving& part);
    void receive_unicast(const AirFrame& air, const Arriving& part);
    void receive_unicast(const AirFrame& air, Reception& reception, std::span<const Dbm> level);

    World& world_;
    Mac& mac_;
    RoutingUser& user_;
    std::optional<Router> router_;
    bool receiving_ = false;                // the router is
    bool calling_ = false;                  // the router is at work
    std::vector<QueuedFrame> outbox_;       // sent by the call that is under way
    Slots<QueuedFrame> waiting_;            // for their time; without a sender: its time has come
    std::vector<Reception> heard_;          // of a frame: that are handed up, ...
    std::vector<Dbm> heard_levels_;         // ... their levels ...
    std::vector<std::size_t> places_;       // ... and where they belong
    std::vector<std::uint32_t> packets_;    // by node: of the protocol's own, made so far
    const Reception* handed_up_ = nullptr;  // the first under work ...
    std::span<const Dbm> levels_;           // ... and the levels of all
};

}  // namespace rovernet
