// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "network/channel.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace rovernet {

struct World;

/// Layer above the MAC, as the MAC knows it. Routing is one.
class MacUser {
  public:
    /// Tells that a frame of a message arrives at some of its receivers, see ChannelUser::arrived.
    /// Control frames stay below.
    virtual void arrived(const AirFrame& frame, const Arriving& part) = 0;
    /// Tells of the end of a frame: it was sent, and acknowledged if the access model does that.
    /// Each frame given to Mac::send ends by one call of this or of lost().
    virtual void sent(const QueuedFrame& frame) = 0;
    /// Tells that a frame was given up, and why.
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~MacUser() = default;
};

/// MAC layer: gets frames to the channel when the access model lets them go, and tells that model
/// what its stations hear.
///
/// It knows no access model by name: one Access, made by the settings, decides for all nodes, and
/// calls back through Air. The MAC adds what all models share: records of what is on air, bit
/// rates, airtimes, timers and draws.
class Mac final : public Air, public ChannelUser {
  public:
    /// Makes the access model of the settings.
    /// @param user  layer above, which may still be under construction
    /// @throws std::invalid_argument for settings of the access model that are out of range
    Mac(World& world, Channel& channel, MacUser& user);

    /// Adds the next node.
    void add() { access_->add(); }
    /// Takes note that a node was switched off: its queue is lost.
    void switch_off(NodeId node) { access_->switch_off(*this, node); }
    /// Takes waiting frames out of a node's queue, see LinkLayer::take_queued.
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) {
        return access_->take(node, next_hop);
    }
    /// Takes a frame that its sender, which is on, wants to send, and whose message is held for it;
    /// sent() or lost() tells of its end.
    void send(const QueuedFrame& frame) { access_->send(*this, frame); }
    /// Serves a timer of the access model.
    void on_timer(NodeId node, std::uint32_t tag) { access_->on_timer(*this, node, tag); }

    /// Whether frames wait for access, so that a sender may hand over more than one.
    bool queues() const { return access_->queues(); }
    /// Whether unicasts are acknowledged.
    bool acknowledges() const { return listens_; }
    /// Bit rates [bit/s], beside those of the radios, at which frames may go.
    std::span<const BitRate> own_rates() const { return access_->own_rates(); }
    /// Bytes that access adds to a message.
    std::uint32_t header() const { return header_; }
    /// Whether `frame` repeats one that `node` has already: its sender missed the acknowledgement.
    /// It must be asked once for each frame received.
    bool is_repeated(NodeId node, const AirFrame& frame) {
        return listens_ && access_->is_repeated(node, frame);
    }

    // Air, for the access model.
    Time now() const override;
    /// Puts a frame on air: emits Transmitted and AirSent, finds rate and airtime, and gives it to
    /// the channel.
    Time transmit(const AirFrame& frame) override;
    /// Airtime [ns] and size [bytes] of a frame, as the access model counts them.
    Duration airtime(const AirFrame& frame) const override;
    std::uint32_t bytes(const AirFrame& frame) const override;
    void access_timer(NodeId node, Time at, std::uint32_t tag) override;
    double access_draw(NodeId node, std::uint64_t index) const override;
    void sent(const QueuedFrame& frame) override { user_.sent(frame); }
    void lost(const QueuedFrame& frame, DropReason reason) override { user_.lost(frame, reason); }

    // ChannelUser, for the channel.
    void arrived(const AirFrame& frame, const Arriving& part) override;
    void sensed(std::span<const Sensing> nodes) override { access_->sensed(*this, nodes); }

  private:
    // Bit rate at which a frame goes: the sender's, unless the access model has its own.
    BitRate rate_of(const AirFrame& frame) const;
    // Emits a record of a unicast whose destination cannot hear it, if no missing acknowledgement
    // tells.
    void tell_if_unheard(const Frame& frame, std::span<const Reception> receptions);
    // Tells the access model what each station has received or missed.
    void tell_stations(const AirFrame& frame, std::span<const Reception> receptions);

    World& world_;
    Channel& channel_;
    MacUser& user_;
    // Access model of all nodes.
    std::unique_ptr<Access> access_;
    // Facts that the access model says of itself, and that never change.
    bool listens_, has_own_rates_;
    // Bytes that access adds to a message.
    std::uint32_t header_;
};

}  // namespace rovernet
