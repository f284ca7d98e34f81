// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "network/channel.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace rovernet {

struct World;

/// What the MAC layer tells the layer above.
class MacUser {
  public:
    /// A frame of a message arrives at some of its receivers, see ChannelUser::arrived.
    virtual void arrived(const AirFrame& frame, const Arriving& part) = 0;
    /// A frame was sent (and answered, if it had to be), or it was given up.
    virtual void sent(const QueuedFrame& frame) = 0;
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~MacUser() = default;
};

/// Gets frames to the channel when the access protocol lets them go, and tells it what its stations
/// hear.
class Mac final : public Air, public ChannelUser {
  public:
    /// @throws std::invalid_argument for settings of the access protocol that are out of range
    Mac(World& world, Channel& channel, MacUser& user);

    /// Adds the next node.
    void add() { access_->add(); }
    void switch_off(NodeId node) { access_->switch_off(*this, node); }
    /// See LinkLayer::take_queued.
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) {
        return access_->take(node, next_hop);
    }
    /// Takes a frame that its sender, which is on, wants to send, and whose message is held for it;
    /// sent() or lost() tells of its end.
    void send(const QueuedFrame& frame) { access_->send(*this, frame); }
    void on_timer(NodeId node, std::uint32_t tag) { access_->on_timer(*this, node, tag); }

    /// Frames wait for access, so that a queue can always have one more.
    bool queues() const { return access_->queues(); }
    /// Unicasts are acknowledged.
    bool acknowledges() const { return listens_; }
    /// Bit rates, beside those of the radios, at which frames may go.
    std::span<const BitRate> own_rates() const { return access_->own_rates(); }
    /// [bytes] that access adds to a message
    std::uint32_t header() const { return header_; }
    /// True if `frame` is a repetition of one that `node` has already.
    bool is_repeated(NodeId node, const AirFrame& frame) {
        return listens_ && access_->is_repeated(node, frame);
    }

    // Air, for the access protocol.
    Time now() const override;
    Time transmit(const AirFrame& frame) override;
    Duration airtime(const AirFrame& frame) const override;
    std::uint32_t bytes(const AirFrame& frame) const override;
    void access_timer(NodeId node, Time at, std::uint32_t tag) override;
    double access_draw(NodeId node, std::uint64_t index) const override;
    void sent(const QueuedFrame& frame) override { user_.sent(frame); }
    void lost(const QueuedFrame& frame, DropReason reason) override { user_.lost(frame, reason); }

    // ChannelUser.
    void arrived(const AirFrame& frame, const Arriving& part) override;
    void sensed(std::span<const Sensing> nodes) override { access_->sensed(nodes); }

  private:
    BitRate rate_of(const AirFrame& frame) const;
    void tell_if_unheard(const Frame& frame, std::span<const Reception> receptions);
    void tell_stations(const AirFrame& frame, std::span<const Reception> receptions);

    World& world_;
    Channel& channel_;
    MacUser& user_;
    std::unique_ptr<Access> access_;
    // What the access protocol says of itself; it never changes.
    bool listens_, has_own_rates_;
    std::uint32_t header_;
};

}  // namespace rovernet
