// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/phy.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

// Interface of access models, which determine when nodes may transmit. A model consists of settings
// with a name and make_access(), and of an Access that serves all nodes; the Mac of the network
// implements Air for it. test/extend/added/models/access/one_slot.hpp is a small one.
//
//     send(frame)  -->  its queue  -->  access_timer  -->  on_timer  -->  Air::transmit
//                                                                    -->  Air::sent, or Air::lost

namespace rovernet {

/// Functions that an access model may call; implemented by the MAC layer.
class Air {
  public:
    /// Time of the current event.
    virtual Time now() const = 0;
    /// Transmits a frame now. Access::sensed is called from within the call.
    /// @return end of the frame at its sender
    virtual Time transmit(const AirFrame& frame) = 0;
    /// Airtime of a frame [ns]. For an ACK to `everyone`: the longest airtime any ACK can have
    /// (used for EIFS).
    virtual Duration airtime(const AirFrame& frame) const = 0;
    /// Size of a frame on air [bytes], including the bytes that the access model adds.
    virtual std::uint32_t bytes(const AirFrame& frame) const = 0;
    /// Sets a timer that calls the model's on_timer(node, tag) at `at`. A timer cannot be
    /// cancelled: store the valid time and compare.
    virtual void access_timer(NodeId node, Time at, std::uint32_t tag) = 0;
    /// Uniform draw in (0, 1), the `index`-th of this node for channel access.
    virtual double access_draw(NodeId node, std::uint64_t index) const = 0;
    /// Reports the end of a frame passed to send(): it was transmitted, and acknowledged if
    /// required. Each frame causes exactly one call of sent() or lost().
    virtual void sent(const QueuedFrame& frame) = 0;
    /// Reports the end of a frame that was dropped. The MAC emits a record of it.
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~Air() = default;
};

/// Access model of a Network: one object with the queues and states of all nodes. Functions that
/// are not pure virtual have a default for simple models.
///
/// A listening model (carrier sensing) is notified of every frame at every station that senses it:
/// of its times when it starts, and whether it was received when it ends.
class Access {
  public:
    /// Destructor; the Mac owns the model.
    virtual ~Access() = default;

    /// Adds the node with the next id.
    virtual void add() {}
    /// Accepts a frame from its sender; it ends with a call of Air::sent or Air::lost.
    virtual void send(Air& air, const QueuedFrame& frame) = 0;
    /// Serves a timer set by Air::access_timer.
    virtual void on_timer(Air& /*air*/, NodeId /*node*/, std::uint32_t /*tag*/) {}
    /// Removes the frames for `next_hop` from the node's queue, except a frame that is on air or
    /// waits for its acknowledgement. They count as neither sent nor lost: the routing protocol
    /// sends them on another path.
    virtual std::vector<QueuedFrame> take(NodeId /*node*/, NodeId /*next_hop*/) { return {}; }
    /// Clears the queue of a node that was switched off; its frames are lost.
    virtual void switch_off(Air& /*air*/, NodeId /*node*/) {}

    /// Whether frames wait in a queue. Saturated traffic needs a queue: otherwise sending would be
    /// unlimited.
    virtual bool queues() const { return true; }
    /// Whether QueuedFrame::is_control matters.
    virtual bool has_priority() const { return false; }
    /// Whether stations listen: sensed(), received() and missed() are called, and a unicast without
    /// an acknowledgement is repeated.
    virtual bool listens() const { return false; }
    /// Called when a frame starts, with the nodes that sense it and the times between which they
    /// do. Only for listening models, like the next three functions.
    virtual void sensed(Air& /*air*/, std::span<const Sensing> /*nodes*/) {}
    /// Called when a frame ended at `node` and was received.
    virtual void received(Air& /*air*/, NodeId /*node*/, const AirFrame& /*frame*/) {}
    /// Called when a frame ended at `node`, which could have decoded it, and was lost.
    /// @param locked  the receiver had locked onto the frame, see Reception::locked
    virtual void missed(Air& /*air*/, NodeId /*node*/, bool /*locked*/) {}
    /// Whether `frame` repeats a frame that `node` already has. It is called once for each received
    /// unicast, and may update the node's state.
    virtual bool is_repeated(NodeId /*node*/, const AirFrame& /*frame*/) { return false; }

    /// Bytes that the access model adds to a message.
    virtual std::uint32_t header() const { return 0; }
    /// Bit rate of a frame.
    /// @param sender    bit rate of the sender's radio
    /// @param receiver  bit rate of the receiver's radio for a unicast, otherwise the sender's
    virtual BitRate rate(const AirFrame& /*frame*/, BitRate sender, BitRate /*receiver*/) const {
        return sender;
    }
    /// Bit rates of the model's frames, in addition to those of the radios; the reception model
    /// checks them.
    virtual std::span<const BitRate> own_rates() const { return {}; }
    /// Physical layer of the model's frames.
    virtual Phy phy() const = 0;
};

/// Settings of an access model: its name, and a function that creates it.
template <class T>
concept MakesAccess = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_access() } -> std::same_as<std::unique_ptr<Access>>;
};

/// Settings of any access model, stored by value. NetworkSettings::access is one:
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
    /// Whether stations listen, see Access::listens.
    bool listens() const { return make_access()->listens(); }
    /// Physical layer of its frames, see Access::phy.
    Phy phy() const { return make_access()->phy(); }

  private:
    // Name of the settings, and the function that creates their model.
    std::string_view name_;
    std::function<std::unique_ptr<Access>()> make_;
};

}  // namespace rovernet
