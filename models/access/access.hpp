// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/wifi.hpp"
#include "sim/ids.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/time.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

// The port of access models: how nodes get access to the medium. A model is settings with a name
// and make_access(), and an Access that runs it for all nodes; the Mac of the network implements
// Air for it. test/extend/added/models/access/one_slot.hpp is a small one.
//
//     send(frame)  -->  its queue  -->  access_timer  -->  on_timer  -->  Air::transmit
//                                                                    -->  Air::sent, or Air::lost

namespace rovernet {

/// Takes the frames for `next_hop` out of a queue but for the first, which is being sent: what
/// Access::take does in a model with a queue. The order of both parts stays.
inline std::vector<QueuedFrame> take_waiting(std::vector<QueuedFrame>& queue, NodeId next_hop) {
    if (queue.empty()) return {};
    const auto taken = std::stable_partition(
        queue.begin() + 1, queue.end(),
        [&](const QueuedFrame& each) { return each.frame.next_hop != next_hop; });
    std::vector<QueuedFrame> frames(taken, queue.end());
    queue.erase(taken, queue.end());
    return frames;
}

/// Functions that an access model may call. The MAC layer implements them.
class Air {
  public:
    /// Time of the event that is served.
    virtual Time now() const = 0;
    /// Puts a frame on air now. Stations sense it from within the call, see Access::sensed.
    /// @return when it ends at its sender
    virtual Time transmit(const AirFrame& frame) = 0;
    /// Time that a frame is on air [ns]. That of an ACK for everyone is the longest of any ACK.
    virtual Duration airtime(const AirFrame& frame) const = 0;
    /// Size of a frame on air [bytes], what access adds included.
    virtual std::uint32_t bytes(const AirFrame& frame) const = 0;
    /// Calls the model's on_timer(node, tag) at `at`. There is no way back: keep the time that
    /// counts, and compare.
    virtual void access_timer(NodeId node, Time at, std::uint32_t tag) = 0;
    /// Uniform draw in (0, 1) of the node's own access, its `index`-th.
    virtual double access_draw(NodeId node, std::uint64_t index) const = 0;
    /// Tells of the end of a frame that send() was given: it was sent, and answered if it had to
    /// be. Exactly one of sent() and lost() is called for each.
    virtual void sent(const QueuedFrame& frame) = 0;
    /// Tells of the end of a frame: it was given up. The MAC makes a record of it.
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~Air() = default;
};

/// Access model at work: one object for all nodes of a Network, which has their queues and states.
/// The functions that are not pure have a default for models that need no more.
///
/// A model that listens is told of every frame at every station that senses it: when energy comes
/// and goes as it is sent, and whether it was received when it ends.
class Access {
  public:
    /// Models are owned by their Mac.
    virtual ~Access() = default;

    /// Adds the next node.
    virtual void add() {}
    /// Takes a frame to send from its sender; Air::sent or Air::lost tells of its end.
    virtual void send(Air& air, const QueuedFrame& frame) = 0;
    /// Serves a timer that was set by Air::access_timer.
    virtual void on_timer(Air& /*air*/, NodeId /*node*/, std::uint32_t /*tag*/) {}
    /// Takes the frames for `next_hop` out of the node's queue, but for one that is being sent.
    /// They count as neither sent nor lost: the routing protocol sends them another way.
    virtual std::vector<QueuedFrame> take(NodeId /*node*/, NodeId /*next_hop*/) { return {}; }
    /// Takes note that the node was switched off: all in its queue is lost.
    virtual void switch_off(Air& /*air*/, NodeId /*node*/) {}

    /// Whether frames wait for their turn. Saturated traffic needs that: otherwise nothing would
    /// hold it back.
    virtual bool queues() const { return true; }
    /// Whether stations listen: they are told what they sense and what they receive, and a unicast
    /// that nobody answers is repeated.
    virtual bool listens() const { return false; }
    /// Takes note of nodes that will sense a frame that goes on air now, and from when until when.
    /// For models that listen, as are the next three.
    virtual void sensed(Air& /*air*/, std::span<const Sensing> /*nodes*/) {}
    /// Takes note that a frame ended at `node` and was received.
    virtual void received(Air& /*air*/, NodeId /*node*/, const AirFrame& /*frame*/) {}
    /// Takes note that a frame ended at `node`, which could decode it, and was lost.
    /// @param locked  the receiver had begun to receive it, see Reception::locked
    virtual void missed(Air& /*air*/, NodeId /*node*/, bool /*locked*/) {}
    /// Whether `frame` repeats one that `node` has already. It is asked once for each unicast
    /// received, and may remember that.
    virtual bool is_repeated(NodeId /*node*/, const AirFrame& /*frame*/) { return false; }

    /// Bytes that access adds to a message.
    virtual std::uint32_t header() const { return 0; }
    /// Bit rate at which a frame goes.
    /// @param sender    rate of its radio
    /// @param receiver  rate of the receiver's radio if the frame is for one node, else that of the
    /// sender
    virtual BitRate rate(const AirFrame& /*frame*/, BitRate sender, BitRate /*receiver*/) const {
        return sender;
    }
    /// Bit rates, beside those of the radios, at which frames may go; the reception model checks
    /// them.
    virtual std::span<const BitRate> own_rates() const { return {}; }
    /// Physical layer that its frames go by: how long they are on air, and how likely their bits
    /// are right.
    virtual Phy phy() const { return Wifi{}; }
};

/// Settings of an access model: they name it and make it.
template <class T>
concept MakesAccess = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_access() } -> std::same_as<std::unique_ptr<Access>>;
};

/// Settings of any access model, held by value. NetworkSettings::access is one:
///
///   Network network({.access = Aloha{}});
class AccessModel {
  public:
    template <class T>
    requires(!std::same_as<T, AccessModel> && MakesAccess<T>) AccessModel(T settings)
        : name_(T::name),
          make_([settings = std::move(settings)] { return settings.make_access(); }) {}

    /// Name of the model, as in files.
    std::string_view name() const { return name_; }

    /// Model for one Network. @throws std::invalid_argument if a setting is out of its range
    std::unique_ptr<Access> make_access() const { return make_(); }
    /// Whether stations listen, see Access::listens.
    bool listens() const { return make_access()->listens(); }
    /// Physical layer of its frames, see Access::phy.
    Phy phy() const { return make_access()->phy(); }

  private:
    // Name of the settings, and a function that makes their model.
    std::string_view name_;
    std::function<std::unique_ptr<Access>()> make_;
};

}  // namespace rovernet
