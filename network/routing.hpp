// SPDX-License-Identifier: MIT
#pragma once

#include "network/mac.hpp"
#include "sim/ports.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
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
    bool has_router() const { return router_.has_value(); }
    Hops initial_ttl() const { return router_->initial_ttl(); }
    /// A node's application sends a message.
    void originate(NodeId node, MessageId message) { router_->send(*this, node, message); }
    void on_timer(NodeId node, std::uint64_t tag) { router_->on_timer(*this, node, tag); }

    // LinkLayer, for the router.
    Time now() const override;
    std::size_t size() const override;
    const Message& message(MessageId id) const override;
    bool is_on(NodeId node) const override;
    std::uint64_t key(NodeId node) const override;
    void broadcast(const Frame& frame, std::optional<NodeId> heard_from) override;
    void unicast(const Frame& frame, std::optional<NodeId> heard_from) override {
        broadcast(frame, heard_from);
    }
    void drop(NodeId node, const Frame& frame, DropReason reason) override;
    void timer(NodeId node, Time at, std::uint64_t tag) override;
    void hold(MessageId id) override;
    void release(MessageId id) override;
    double draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const override;

    // MacUser.
    void arrived(const AirFrame& frame, std::span<Reception> receptions, bool undisturbed) override;
    void sent(const QueuedFrame& frame) override;
    void lost(const QueuedFrame& frame, DropReason reason) override;

  private:
    void hand_up(const Frame& frame, std::span<Reception> receptions);
    void hand_up_heard(const Frame& frame, std::span<Reception> receptions);
    void receive_broadcast(const AirFrame& air, std::span<Reception> receptions, bool undisturbed);
    void receive_unicast(const AirFrame& air, std::span<Reception> receptions);

    World& world_;
    Mac& mac_;
    RoutingUser& user_;
    std::optional<Router> router_;
    bool receiving_ = false;
    std::vector<Reception> heard_;     // of a frame: that are handed up ...
    std::vector<std::size_t> places_;  // ... and where they belong
};

}  // namespace rovernet
