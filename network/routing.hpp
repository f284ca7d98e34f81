// SPDX-License-Identifier: MIT
#pragma once

#include "network/arp.hpp"
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

/// Interface of the layer above routing, implemented by Applications. Layers are connected only by
/// such small interfaces, so that each layer can be tested alone.
class RoutingUser {
  public:
    /// Called for receptions of a frame. Reception::delivered is true if the reception's node
    /// passes the message to its application.
    /// @param levels  received power of each reception [dBm], NaN at nodes for which no power is
    ///                requested; may be empty
    virtual void delivered(const Frame& frame, std::span<const Reception> receptions,
                           std::span<const Dbm> levels) = 0;
    /// Called when a frame of an application's message has left the interface queue of `node`: the
    /// frame was sent, or lost.
    /// @param has_room  whether the queue has space for one more frame
    virtual void left_queue(NodeId node, const Message& message, bool has_room) = 0;

  protected:
    ~RoutingUser() = default;
};

/// Routing layer: forwards messages hop by hop. Routing contains the routing protocol, and
/// implements the link layer that the protocol calls.
///
/// Frames that the protocol sends immediately leave after the protocol's function has returned, so
/// that the protocol is not called back inside its own functions. Frames for a later time wait in
/// Routing, each with an event. Messages over one hop bypass the protocol.
class Routing final : public LinkLayer, public MacUser, public ArpUser {
  public:
    /// @param user  layer above, which may still be under construction
    /// @throws std::invalid_argument if a setting of ARP is out of its range
    Routing(World& world, Mac& mac, RoutingUser& user);

    /// Sets the protocol of all nodes, and reads its traits.
    /// @throws std::invalid_argument if a protocol is already set
    void set(Router router);
    /// Routing protocol of all nodes; empty if no protocol is set.
    const std::optional<Router>& router() const { return router_; }
    /// Passes to the protocol a message that a node's application sends; a protocol must be set.
    void originate(NodeId node, MessageId message);
    /// Passes a frame to the MAC immediately, without the routing protocol. Adds a reference to the
    /// frame's message.
    void send_one_hop(const Frame& frame);
    /// Serves the event of a timer that the protocol has set at `node`, with the timer's tag.
    void on_timer(NodeId node, std::uint64_t tag);
    /// Serves the event of a frame whose send time has come: passes the frame down.
    void on_send(SendHandle handle);
    /// Sets the role of a node that was just added.
    void set_role(NodeId node, std::string role);
    /// Checks the roles of all nodes, and calls the protocol's on_start for them at the start of
    /// the run, in the order of their keys.
    void start();
    /// Serves an event of address resolution (ARP) at `node`, for the address of `neighbour`.
    void on_arp(NodeId node, NodeId neighbour);
    /// Calls the protocol's on_start for a node added after the start of the run; or on_switched
    /// for a node that was switched on or off.
    void on_start(NodeId node);
    void on_switched(NodeId node, bool on);
    /// Checks at the end of the run, in a debug build, that the protocol holds references only to
    /// messages that it keeps (Router::keeps). @throws std::logic_error naming a message
    void check_held() const;

    // Implementation of LinkLayer, for the protocol: see sim/routing_protocol.hpp.
    Time now() const override;
    std::size_t size() const override;
    const Message& message(MessageId id) const override;
    bool is_on(NodeId node) const override;
    std::uint64_t key(NodeId node) const override;
    void prefetch(NodeId node) const override;
    Vec3 position(NodeId node) const override;
    std::string_view role(NodeId node) const override;
    MessageId originate(NodeId from, NodeId to, std::string_view kind, std::uint32_t bytes,
                        std::string content) override;
    std::optional<SendHandle> send(const Frame& frame, std::optional<NodeId> heard_from,
                                   Time at) override;
    Duration spacing(const Frame& frame) const override;
    QueuedFrame* waiting(SendHandle handle) override;
    void cancel(SendHandle handle) override;
    std::vector<QueuedFrame> take_queued(NodeId node, NodeId next_hop) override;
    void drop(NodeId node, const Frame& frame, DropReason reason,
              std::string_view own_code = {}) override;
    Dbm level(const Reception& reception) const override;
    Db snr(const Reception& reception) const override;
    void timer(NodeId node, Time at, std::uint64_t tag) override;
    void hold(MessageId id) override;
    void release(MessageId id) override;
    void hold(const Frame& frame) override;
    void release(const Frame& frame) override;
    double draw(Purpose purpose, NodeId node, MessageId id, std::uint64_t index) const override;
    double draw(Purpose purpose, NodeId node, std::uint64_t index) const override;

    // Implementation of MacUser, for the MAC.
    void frame_ended(const AirFrame& frame, const Arriving& part) override;
    void sent(const QueuedFrame& frame, bool acked) override;
    void lost(const QueuedFrame& frame, DropReason reason) override;
    bool wants_result(const Frame& frame) const override;

    // Implementation of ArpUser, for address resolution.
    void send_resolved(const QueuedFrame& frame) override { mac_.send(frame); }
    void unresolved(const QueuedFrame& frame, bool is_displaced) override;

  private:
    // Passes a frame from a node that is on to the MAC; or to ARP if the next hop's address is
    // unknown.
    void pass_down(const QueuedFrame& frame);
    // Emits Dropped for a frame that was not transmitted, and reports the result to the protocol.
    void lose(const QueuedFrame& frame, DropReason reason, SendResult result);
    void end(const Frame& frame, bool has_room);
    // Throws std::invalid_argument if the protocol does not know the role of the node.
    void check_role(NodeId node) const;
    // Calls the protocol by `call`, then passes down the frames that the protocol queued meanwhile.
    template <class Call>
    void call_router(Call call);
    // Passes a frame to the MAC, or drops it if its sender is off.
    void send_now(const QueuedFrame& frame);
    // Reports the result of a frame to the protocol, if the protocol has the function on_sent.
    void tell(const QueuedFrame& frame, SendResult result);
    // Emits a Dropped record with the data of `frame`, for the frame `sending` that `node` has
    // lost.
    void drop_sending(NodeId node, const Frame& frame, const Frame& sending, DropReason reason);
    // Emits Received, and after each reception the Dropped records that the protocol made for the
    // reception's node in on_receive.
    void emit_with_drops(const Received& record);
    // Emits the Dropped records that the protocol made in on_receive. Before each record, calls
    // before(place) with the index of the node's reception.
    template <class Before>
    void emit_drops(std::span<const Reception> receptions, Before before);
    // Adds `change` to the number of the protocol's references to a message, in a debug build.
    void count_holds(MessageId id, int change);
    // Passes receptions to the protocol, which sets their fate. Without a protocol, the message is
    // delivered at each node, and not forwarded.
    void hand_up(const Frame& frame, std::span<Reception> receptions, std::span<const Dbm> levels);
    // Calls hand_up() for those receptions of a group that were decoded, and whose nodes are on.
    void hand_up_heard(const Frame& frame, const Arriving& part);
    // Handles receptions of a broadcast: passes them to the protocol, emits Received, and passes
    // them to the applications.
    void receive_broadcast(const AirFrame& air, const Arriving& part);
    // Handles receptions of a unicast: at its destination, and at nodes that overhear it.
    void receive_unicast(const AirFrame& air, const Arriving& part);
    // Handles the reception of a unicast at its destination.
    void receive_unicast(const AirFrame& air, Reception& reception, std::span<const Dbm> level);

    // World of the network.
    World& world_;
    // Layer below routing (MAC), and layer above routing (applications).
    Mac& mac_;
    RoutingUser& user_;
    // Address resolution (ARP); empty unless the settings enable ARP.
    std::optional<Arp> arp_;
    // Routing protocol of all nodes; without a protocol, messages go over one hop only.
    std::optional<Router> router_;
    // True during on_receive of the protocol, which may not send frames immediately.
    bool receiving_ = false;
    // True during any function of the protocol.
    bool calling_ = false;
    // Frames that the current function of the protocol sends immediately.
    std::vector<QueuedFrame> outbox_;
    // Frames that wait for their send time; an entry without a sender was sent or cancelled.
    Slots<QueuedFrame> waiting_;
    // Receptions of a frame that are passed to hand_up(), their received powers, and their indices
    // among all receptions of the frame; kept to reuse their memory.
    std::vector<Reception> heard_;
    std::vector<Dbm> heard_levels_;
    std::vector<std::size_t> places_;
    // Roles of nodes, by index; nodes beyond the end of the list have no role.
    std::vector<std::string> roles_;
    // Number of control packets that each node has made so far.
    std::vector<std::uint32_t> packets_;
    // Dropped records made by the protocol in on_receive, until Received is emitted. Each record
    // holds a reference to its frame.
    std::vector<Dropped> drops_;
    // Number of the protocol's own references to each message; counted in a debug build.
    std::vector<std::int32_t> held_;
    // Receptions of the current call of the protocol's on_receive: pointer to the first one, and
    // received power of each one [dBm]. level() looks up the power of a reception by its index.
    const Reception* handed_up_ = nullptr;
    std::span<const Dbm> levels_;
};

}  // namespace rovernet
