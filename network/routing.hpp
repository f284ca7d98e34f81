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

/// Layer above the routing layer, as that knows it. Applications is one; the layers know each other
/// by such small interfaces only, so that each can be tested alone.
class RoutingUser {
  public:
    /// Tells of receptions of which some are delivered: their nodes have the message now.
    virtual void delivered(const Frame& frame, std::span<const Reception> receptions) = 0;
    /// Tells that the node's queue has room for one frame more: a frame of it was sent, or given up
    /// after all its attempts.
    virtual void has_room(NodeId node) = 0;

  protected:
    ~RoutingUser() = default;
};

/// Routing layer: gets messages over their hops. It holds the routing protocol, and is the link
/// layer that the protocol works on.
///
/// What the protocol sends now leaves once the protocol's function has returned, so that it is told
/// of nothing in the midst of its work. Frames that are sent later wait here, with an event each. A
/// message goes the protocol's way if it was sent by Network::broadcast or Network::send, and over
/// one hop past it by Network::unicast.
class Routing final : public LinkLayer, public MacUser {
  public:
    /// @param user  layer above, which may still be under construction
    Routing(World& world, Mac& mac, RoutingUser& user) : world_(world), mac_(mac), user_(user) {}

    /// Gives all nodes their protocol, and asks it for its traits.
    /// @throws std::invalid_argument if there is one
    void set(Router router);
    /// Protocol, if there is one.
    const std::optional<Router>& router() const { return router_; }
    /// Takes a message that a node's application sends, and hands it to the protocol; there must be
    /// one.
    void originate(NodeId node, MessageId message);
    /// Sends a frame at once, past the protocol. It holds the frame's message.
    void send_one_hop(const Frame& frame);
    /// Serves the event of a timer that the protocol has set.
    void on_timer(NodeId node, std::uint64_t tag);
    /// Serves the event of a frame that has waited for its time.
    void on_send(SendHandle handle);
    /// Lets the protocol's nodes begin to work, as the run begins: in the order of their keys.
    void start();
    /// Tells the protocol that a node was added after that, or switched.
    void on_start(NodeId node);
    void on_switched(NodeId node, bool on);

    // LinkLayer, for the protocol: see sim/router.hpp.
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

    // MacUser, for the MAC.
    void arrived(const AirFrame& frame, const Arriving& part) override;
    void sent(const QueuedFrame& frame) override;
    void lost(const QueuedFrame& frame, DropReason reason) override;

  private:
    // Calls the protocol, and then sends what it has sent.
    template <class Call>
    void call_router(Call call);
    // Gives a frame to the MAC, or drops it if its sender is off.
    void send_now(const QueuedFrame& frame);
    // Tells the protocol what became of its frame, if it wants to know.
    void tell(const Frame& frame, SendResult result);
    // Hands receptions to the protocol, which fills in their fate; without one they go no further.
    void hand_up(const Frame& frame, std::span<Reception> receptions, std::span<const Dbm> levels);
    // Hands up those receptions of a part that got through to nodes that are on.
    void hand_up_heard(const Frame& frame, const Arriving& part);
    // Receptions of a broadcast: handed up, recorded, and told to the applications.
    void receive_broadcast(const AirFrame& air, const Arriving& part);
    // Receptions of a unicast: by the node that it is for, and by those that overhear it.
    void receive_unicast(const AirFrame& air, const Arriving& part);
    // Reception of a unicast by the node that it is for.
    void receive_unicast(const AirFrame& air, Reception& reception, std::span<const Dbm> level);

    // World, and the layers below and above.
    World& world_;
    // Layers below and above.
    Mac& mac_;
    RoutingUser& user_;
    // Protocol of all nodes; none: messages go over one hop only.
    std::optional<Router> router_;
    // The protocol is in its on_receive: it may not send at once.
    bool receiving_ = false;
    // The protocol is in one of its functions.
    bool calling_ = false;
    // Frames that the function under way has sent.
    std::vector<QueuedFrame> outbox_;
    // Frames that wait for their time; one without a sender was sent or taken back.
    Slots<QueuedFrame> waiting_;
    // Receptions of a frame that are handed up, their levels, and their places among all; kept for
    // their memory.
    std::vector<Reception> heard_;
    std::vector<Dbm> heard_levels_;
    std::vector<std::size_t> places_;
    // Packets of the protocol's own that each node has made so far.
    std::vector<std::uint32_t> packets_;
    // First of the receptions in on_receive, and the levels of all, for level().
    const Reception* handed_up_ = nullptr;
    std::span<const Dbm> levels_;
};

}  // namespace rovernet
