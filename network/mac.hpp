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
    /// frames of the access model are not passed up.
    virtual void frame_ended(const AirFrame& frame, const Arriving& part) = 0;
    /// Called when a frame was transmitted. Each frame passed to Mac::send causes one call of
    /// sent() or lost(), unless Mac::take removed the frame.
    /// @param acked  whether the next hop acknowledged the frame, or is known to have received the
    ///               frame
    virtual void sent(const QueuedFrame& frame, bool acked) = 0;
    /// Called when the MAC has dropped a frame, with the reason.
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;
    /// Whether the layer above needs the result of this unicast: received by the next hop, or not.
    virtual bool wants_result(const Frame& frame) const = 0;

  protected:
    ~MacUser() = default;
};

/// MAC layer: passes frames to the channel when the access model allows it, and reports to the
/// access model which frames its stations receive and sense.
///
/// The MAC works with any access model: one Access, made from the settings, decides for all nodes,
/// and calls the MAC through Air. The MAC adds the common parts: records of frames on air, bit
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
    /// Removes and returns the frames in the queue of `node` for which `is_taken` is true, see
    /// LinkLayer::take_queued.
    std::vector<QueuedFrame> take(NodeId node, const FrameTest& is_taken) {
        return access_->take(node, is_taken);
    }
    /// Accepts a frame from its sender, which must be on. The frame holds a reference to its
    /// message. The MAC later reports the result by MacUser::sent or MacUser::lost.
    void send(const QueuedFrame& frame) { access_->send(*this, frame); }
    /// Serves the event of the end of a unicast whose sender hears no result: reports the result.
    /// @param slot  slot of the frame in unheard_
    void on_unheard(std::size_t slot);
    /// Serves the event of a timer of the access model, with the timer's tag.
    void on_timer(NodeId node, std::uint32_t tag) { access_->on_timer(*this, node, tag); }

    /// Whether the access model sends control packets of the routing protocol before messages.
    bool has_priority() const { return has_priority_; }
    /// Whether the access model queues frames, so that a sender may pass several frames.
    bool queues() const { return access_->queues(); }
    /// Bit rates [bit/s] of the access model's frames, in addition to those of the radios.
    std::span<const BitRate> own_rates() const { return access_->own_rates(); }
    /// Size [bytes] of the header that the access model adds to a message.
    std::uint32_t header() const { return header_; }
    /// Sum [ns] of the airtimes of all frames so far, without frames that began in the warm-up.
    Duration airtime_so_far() const { return airtime_so_far_; }
    /// Whether `frame` is a retransmission of a frame that `node` has already received, because the
    /// sender missed the acknowledgement. Must be called exactly once for each received frame.
    bool is_repeated(NodeId node, const AirFrame& frame) {
        return listens_ && access_->is_repeated(node, frame);
    }

    // Implementation of Air, for the access model.
    Time now() const override;
    /// Transmits a frame: emits Transmitted and AirSent, computes rate and airtime, and passes the
    /// frame to the channel.
    Time transmit(const AirFrame& frame) override;
    /// Transmission of a frame (bit rate, coding, airtime), its airtime [ns], and its size on air
    /// [bytes]; the size includes the bytes that the access model adds.
    const Transmission& transmission(const AirFrame& frame) const;
    Duration airtime(const AirFrame& frame) const override { return transmission(frame).airtime(); }
    std::uint32_t bytes(const AirFrame& frame) const override;
    void access_timer(NodeId node, Time at, std::uint32_t tag) override;
    double access_draw(NodeId node, std::uint64_t index) const override;
    /// Reports the result of a transmitted frame to the user. For a frame with judges() true, the
    /// MAC instead reports the result when the frame ends. A sender that is switched off hears no
    /// acknowledgement: once the frame has ended, the MAC reports whether the next hop has it.
    void sent(const QueuedFrame& frame) override {
        if (judges(frame.frame)) return;
        const bool is_acked = listens_ && frame.frame.next_hop != everyone;
        if (is_acked && !is_on(frame)) return report_end(frame);
        user_.sent(frame, is_acked);
    }
    void lost(const QueuedFrame& frame, DropReason reason) override { user_.lost(frame, reason); }

    // Implementation of ChannelUser, for the channel.
    void frame_ended(const AirFrame& frame, const Arriving& part) override;
    void sensed(std::span<const Sensing> nodes) override { access_->sensed(*this, nodes); }

  private:
    bool is_on(const QueuedFrame& frame) const;
    // Bit rate [bit/s] of a frame: the rate chosen by the access model, by default the rate of the
    // sender's radio.
    BitRate rate_of(const AirFrame& frame) const;
    // Whether the MAC itself finds the result of a unicast: the access model has no
    // acknowledgements, so that the MAC acts as an ideal MAC.
    bool judges(const Frame& frame) const {
        return frame.next_hop != everyone && !listens_ && user_.wants_result(frame);
    }
    // Nodes for which the channel has to simulate the arrival of a frame.
    Audience audience_of(const Frame& frame) const;
    // Handles a unicast whose next hop is out of range. If the MAC finds the result of the unicast
    // itself (see judges()), queues an event at `end`, the end of the frame, that reports the loss
    // to the user. Otherwise emits Dropped immediately.
    void miss(const AirFrame& air, Time end);
    // Queues the event of on_unheard(): for a unicast on air whose sender was switched off, and in
    // general.
    void report_end(const QueuedFrame& frame);
    void await_end(const QueuedFrame& frame, Time end);
    // Reports to the user whether the next hop has received a unicast that ends now.
    void judge(const AirFrame& air, std::span<const Reception> receptions);
    // Reports to the access model which stations have received or missed a frame that ends now.
    void tell_stations(const AirFrame& frame, std::span<const Reception> receptions);

    World& world_;
    Channel& channel_;
    MacUser& user_;
    // Access model of all nodes.
    std::unique_ptr<Access> access_;
    // Constant properties of the access model, read once.
    bool listens_, has_own_rates_, has_priority_;
    // Size [bytes] of the header that the access model adds to a message.
    std::uint32_t header_;
    Duration airtime_so_far_{0};
    // Last computed Transmission, and radio kind of its sender; reused for the next frame if size,
    // bit rate and kind are equal.
    mutable Transmission last_{};
    mutable std::uint32_t last_kind_ = ~std::uint32_t{0};
    // Unicasts on air to a next hop out of range, if the layer above needs their results.
    Slots<QueuedFrame> unheard_;
};

}  // namespace rovernet
