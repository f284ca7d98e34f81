// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/phy.hpp"
#include "sim/fields.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

// Interface of access models, which determine when nodes may transmit. A model consists of
// settings, which have a name and make_access(), and of an Access that serves all nodes. The
// network's Mac implements Air for the model. Small example:
// test/extend/added/models/access/one_slot.hpp.
//
//     send(frame)  -->  the queue  -->  access_timer  -->  on_timer  -->  Air::transmit
//                                                                    -->  Air::sent, or Air::lost

namespace rovernet {

/// Condition on a frame.
using FrameTest = std::function<bool(const Frame&)>;

/// Functions that an access model may call; implemented by the MAC layer.
class Air {
  public:
    /// Time of the current event.
    virtual Time now() const = 0;
    /// Transmits a frame now. Calls Access::sensed before it returns.
    /// @return end of the frame at its sender
    virtual Time transmit(const AirFrame& frame) = 0;
    /// Airtime of a frame [ns]. For an ACK with next hop `everyone`, the longest airtime that any
    /// ACK can have (used for EIFS).
    virtual Duration airtime(const AirFrame& frame) const = 0;
    /// Size of a frame on air [bytes], including the bytes that the access model adds.
    virtual std::uint32_t bytes(const AirFrame& frame) const = 0;
    /// Sets a timer that calls the model's on_timer(node, tag) at `at`. A timer cannot be
    /// cancelled: the model stores the time of its valid timer, and ignores calls at other times.
    virtual void access_timer(NodeId node, Time at, std::uint32_t tag) = 0;
    /// Uniform random number in (0, 1) for channel access: draw number `index` of the node, from 0.
    virtual double access_draw(NodeId node, std::uint64_t index) const = 0;
    /// Reports that a frame passed to Access::send() was transmitted, and acknowledged if required;
    /// or that its sender was switched off after the transmission began.
    /// Each frame causes exactly one call of sent() or lost(), unless Access::take() removed it.
    virtual void sent(const QueuedFrame& frame) = 0;
    /// Reports that a frame passed to Access::send() was dropped. The network emits a Dropped
    /// record.
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~Air() = default;
};

/// Access model of a Network: one object with the queues and states of all nodes. Functions that
/// are not pure virtual have a default, which suits simple models.
///
/// A listening model (carrier sensing) is notified of every frame at every station that senses the
/// frame. When the frame starts, sensed() passes its begin and end at the station. When the frame
/// ends, the call of received() or missed() reports whether the station received the frame.
class Access {
  public:
    /// Virtual destructor, because the Mac owns the model by a pointer to Access.
    virtual ~Access() = default;

    /// Adds a station: the node with the next id, from 0.
    virtual void add() {}
    /// Accepts a frame that its sender has to transmit. The model reports the result by Air::sent
    /// or Air::lost, now or later.
    virtual void send(Air& air, const QueuedFrame& frame) = 0;
    /// Called when a timer that the model set by Air::access_timer is due, with the timer's tag.
    virtual void on_timer(Air& /*air*/, NodeId /*node*/, std::uint32_t /*tag*/) {}
    /// Removes and returns the frames in the node's queue for which `is_taken` is true, except a
    /// frame that is on air or waits for its acknowledgement. Removed frames count as neither sent
    /// nor lost: the routing protocol may send these frames to a different next hop.
    virtual std::vector<QueuedFrame> take(NodeId /*node*/, const FrameTest& /*is_taken*/) {
        return {};
    }
    /// Clears the queue of a node that was switched off; its frames are lost.
    virtual void switch_off(Air& /*air*/, NodeId /*node*/) {}

    /// Number of frames in the node's queue, with the one that is being sent; 0 without a queue.
    virtual std::size_t queued(NodeId /*node*/) const { return 0; }
    /// Whether frames wait in a queue for channel access. Saturated traffic needs a queue: without
    /// one, a node would send without limit.
    virtual bool queues() const { return true; }
    /// Whether control packets of the routing protocol (QueuedFrame::is_control) have priority.
    virtual bool has_priority() const { return false; }
    /// Whether stations sense the carrier. If true, the MAC calls sensed(), received(), missed()
    /// and is_repeated(), and a unicast without an acknowledgement is retransmitted.
    virtual bool listens() const { return false; }
    /// Called when a frame starts, with the nodes that sense the frame, and its begin and end at
    /// each of these nodes. Only called if listens().
    virtual void sensed(Air& /*air*/, std::span<const Sensing> /*nodes*/) {}
    /// Called when a frame has ended at `node` and was received. Only called if listens().
    virtual void received(Air& /*air*/, NodeId /*node*/, const AirFrame& /*frame*/) {}
    /// Called when a frame has ended at `node` and was lost, although `node` could have decoded it
    /// without interference. Only called if listens().
    /// The flag says whether the receiver had locked onto the frame, see Reception::locked.
    virtual void missed(Air& /*air*/, NodeId /*node*/, bool /*locked*/) {}
    /// Whether `frame` is a retransmission of a frame that `node` has already received. Called once
    /// for each received unicast, if listens(); it may update the node's state.
    virtual bool is_repeated(NodeId /*node*/, const AirFrame& /*frame*/) { return false; }

    /// Size [bytes] of the header that the access model adds to a message.
    virtual std::uint32_t header() const { return 0; }
    /// Bit rate [bit/s] at which a frame is transmitted. For a unicast, the third argument is the
    /// bit rate of the receiver's radio; otherwise it is the bit rate of the sender's radio.
    /// @param sender  bit rate of the sender's radio
    virtual BitRate rate(const AirFrame& /*frame*/, BitRate sender, BitRate /*receiver*/) const {
        return sender;
    }
    /// Bit rates [bit/s] of the model's frames, in addition to those of the radios. The reception
    /// model checks each rate when the network is set up.
    virtual std::span<const BitRate> own_rates() const { return {}; }
    /// Physical layer of the model's frames.
    virtual Phy phy() const = 0;
};

/// Type of an access model's settings: has the model's name, and a function that creates the model.
template <class T>
concept MakesAccess = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_access() } -> std::same_as<std::unique_ptr<Access>>;
};

/// Settings of any access model, stored by value; the type of NetworkSettings::access:
///
///   Network network({.access = Aloha{}});
class AccessModel {
  public:
    template <class T>
    requires(!std::same_as<T, AccessModel> && MakesAccess<T>) AccessModel(T settings)
        : name_(T::name),
          make_([settings = std::move(settings)] { return settings.make_access(); }) {}

    /// Name of the model in scenario files.
    std::string_view name() const { return name_; }

    /// Creates the model for one Network. @throws std::invalid_argument if a setting is out of its
    /// range
    std::unique_ptr<Access> make_access() const { return make_(); }
    /// Whether stations of the model sense the carrier, see Access::listens.
    bool listens() const { return make_access()->listens(); }
    /// Physical layer of the model's frames, see Access::phy.
    Phy phy() const { return make_access()->phy(); }

  private:
    // Name of the access model, and the function that creates the model from its settings.
    std::string_view name_;
    std::function<std::unique_ptr<Access>()> make_;
};

/// Settings of address resolution (ARP, RFC 826): keys of [access], like the access model's keys.
/// With ARP a robot requests the MAC address of a next hop by a broadcast before its first unicast
/// to this next hop. Without ARP all addresses are known.
struct ArpSettings {
    /// Whether robots resolve addresses.
    bool arp = false;
    /// Time after which an address is forgotten [ns], > 0; empty: never, as in ns-2.
    std::optional<Duration> arp_timeout = std::nullopt;

    static constexpr auto fields() {
        return describe(field("arp", &ArpSettings::arp,
                              "true: before a robot sends its first unicast to a next hop, it "
                              "requests the hardware address of this next hop"),
                        field("arp_timeout", &ArpSettings::arp_timeout,
                              Range{.low = 0, .high = 1e18, .low_included = false, .text = "> 0 s"},
                              "time after which a robot forgets the hardware address of a next "
                              "hop; if not given, never"));
    }
};

}  // namespace rovernet
