// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "network/channel.hpp"
#include "sim/slots.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace rovernet {

struct World;

/// Interface of the layer above the MAC. Routing implements it.
class MacUser {
  public:
    /// Called when a frame of a message ends at some of its receivers, see ChannelUser. Control
    /// frames are not passed up.
    virtual void frame_ended(const AirFrame& frame, const Arriving& part) = 0;
    /// Called when a frame was transmitted. Each frame passed to Mac::send causes one call of
    /// sent() or lost(), unless it was taken.
    /// @param acked  the next hop acknowledged it, or is known to have received it
    virtual void sent(const QueuedFrame& frame, bool acked) = 0;
    /// Called when a frame was dropped, with the reason.
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;
    /// Whether somebody waits for the result of this unicast.
    virtual bool wants_result(const Frame& frame) const = 0;

  protected:
    ~MacUser() = default;
};

/// MAC layer: passes frames to the channel when the access model allows it, and reports to the
/// access model what its stations receive and sense.
///
/// It depends on no particular access model: one Access, made from the settings, decides for all
/// nodes, and calls back through Air. The MAC adds the common parts: records of frames on air, bit
/// rates, airtimes, timers and random draws.
class Mac final : public Air, public ChannelUser {
  public:
    /// Creates the access model of the settings.
    /// @param user  layer above, which may still be under construction
    /// @throws std::invalid_argument for settings of the access model that are out of range
    Mac(World& world, Channel& channel, MacUser& user);

    /// Adds the next node to the access model.
    void add() { access_->add(); }
    /// Clears the queue of a node that was switched off.
    void switch_off(NodeId node) { access_->switch_off(*this, node); }
    /// Removes waiting frames from a node's queue, see LinkLayer::take_queued.
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) {
        return access_->take(node, next_hop);
    }
    /// Accepts a frame from its sender, which must be on; the frame holds a reference to its
    /// message. Ends with a call of sent() or lost().
    void send(const QueuedFrame& frame) { access_->send(*this, frame); }
    /// Serves the event of a unicast that its next hop, out of range, did not receive: it ends now.
    void on_unheard(std::size_t slot);
    /// Serves a timer of the access model.
    void on_timer(NodeId node, std::uint32_t tag) { access_->on_timer(*this, node, tag); }

    /// Whether control packets of the routing protocol go first.
    bool has_priority() const { return has_priority_; }
    /// Whether frames wait in a queue for access, so that a sender may pass several frames.
    bool queues() const { return access_->queues(); }
    /// Bit rates [bit/s] of the access model's frames, in addition to those of the radios.
    std::span<const BitRate> own_rates() const { return access_->own_rates(); }
    /// Bytes that the access model adds to a message.
    std::uint32_t header() const { return header_; }
    /// Sum of the airtimes of all frames that began after the warm-up [ns].
    Duration airtime_so_far() const { return airtime_so_far_; }
    /// Whether `frame` repeats a frame that `node` already has, because its sender missed the
    /// acknowledgement. It must be called exactly once for each received frame.
    bool is_repeated(NodeId node, const AirFrame& frame) {
        return listens_ && access_->is_repeated(node, frame);
    }

    // Implementation of Air, for the access model.
    Time now() const override;
    /// Transmits a frame: emits Transmitted and AirSent, computes rate and airtime, and passes the
    /// frame to the channel.
    Time transmit(const AirFrame& frame) override;
    /// Transmission, airtime [ns] and size [bytes] of a frame, including the access model's
    /// additions.
    const Transmission& transmission(const AirFrame& frame) const;
    Duration airtime(const AirFrame& frame) const override { return transmission(frame).airtime(); }
    std::uint32_t bytes(const AirFrame& frame) const override;
    void access_timer(NodeId node, Time at, std::uint32_t tag) override;
    double access_draw(NodeId node, std::uint64_t index) const override;
    /// A unicast that the MAC judges has its result when it ends.
    void sent(const QueuedFrame& frame) override {
        if (judges(frame.frame)) return;
        user_.sent(frame, listens_ && frame.frame.next_hop != everyone);
    }
    void lost(const QueuedFrame& frame, DropReason reason) override { user_.lost(frame, reason); }

    // Implementation of ChannelUser, for the channel.
    void frame_ended(const AirFrame& frame, const Arriving& part) override;
    void sensed(std::span<const Sensing> nodes) override { access_->sensed(*this, nodes); }

  private:
    // Bit rate of a frame: the sender's, unless the access model sets its own.
    BitRate rate_of(const AirFrame& frame) const;
    // Whether the MAC, in place of the access model, finds the result of a unicast: an ideal MAC.
    bool judges(const Frame& frame) const {
        return frame.next_hop != everyone && !listens_ && user_.wants_result(frame);
    }
    // Ends a unicast whose next hop has not received it, because it is out of range.
    void miss(const AirFrame& air, Time end);
    // Reports the result of a unicast that ends at its next hop.
    void judge(const AirFrame& air, std::span<const Reception> receptions);
    // Reports to the access model which stations have received or missed the frame.
    void tell_stations(const AirFrame& frame, std::span<const Reception> receptions);

    World& world_;
    Channel& channel_;
    MacUser& user_;
    // Access model of all nodes.
    std::unique_ptr<Access> access_;
    // Constant properties of the access model.
    bool listens_, has_own_rates_, has_priority_;
    // Bytes that the access model adds to a message.
    std::uint32_t header_;
    Duration airtime_so_far_{0};
    // Last transmission, and the kind of its sender.
    mutable Transmission last_{};
    mutable std::uint32_t last_kind_ = ~std::uint32_t{0};
    // Unicasts on air to a next hop out of range, if somebody waits for their results.
    Slots<QueuedFrame> unheard_;
};

}  // namespace rovernet
