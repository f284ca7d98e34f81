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

namespace rovernet {

/// Takes the frames for `next_hop` out of a queue but for the first, which is being sent.
inline std::vector<QueuedFrame> take_waiting(std::vector<QueuedFrame>& queue, NodeId next_hop) {
    if (queue.empty()) return {};
    const auto taken = std::stable_partition(
        queue.begin() + 1, queue.end(),
        [&](const QueuedFrame& each) { return each.frame.next_hop != next_hop; });
    std::vector<QueuedFrame> frames(taken, queue.end());
    queue.erase(taken, queue.end());
    return frames;
}

/// What an access protocol may do. Implemented by the Network.
class Air {
  public:
    virtual Time now() const = 0;
    /// Puts a frame on air now; returns when it ends at its sender.
    virtual Time transmit(const AirFrame& frame) = 0;
    /// How long a frame is on air [ns], and how large it is then [bytes]. An ACK for everyone is
    /// the longest that anybody sends.
    virtual Duration airtime(const AirFrame& frame) const = 0;
    virtual std::uint32_t bytes(const AirFrame& frame) const = 0;
    /// Calls the protocol's on_timer(node, tag) at `at`.
    virtual void access_timer(NodeId node, Time at, std::uint32_t tag) = 0;
    /// A uniform draw in (0, 1) of the node's own access, its `index`-th.
    virtual double access_draw(NodeId node, std::uint64_t index) const = 0;
    /// The frame left the queue: it was sent (and answered, if it had to be), or it was given up.
    virtual void sent(const QueuedFrame& frame) = 0;
    virtual void lost(const QueuedFrame& frame, DropReason reason) = 0;

  protected:
    ~Air() = default;
};

/// How nodes get access to the medium: one protocol for all nodes of a Network.
class Access {
  public:
    virtual ~Access() = default;

    /// Adds the next node.
    virtual void add() {}
    /// The router hands over a frame; Air::sent or Air::lost tells of its end.
    virtual void send(Air& air, const QueuedFrame& frame) = 0;
    virtual void on_timer(Air& /*air*/, NodeId /*node*/, std::uint32_t /*tag*/) {}
    /// Takes the frames for `next_hop` out of the node's queue, but for one that is being sent.
    virtual std::vector<QueuedFrame> take(NodeId /*node*/, NodeId /*next_hop*/) { return {}; }
    /// The node was switched off: what it had to send is lost.
    virtual void switch_off(Air& /*air*/, NodeId /*node*/) {}

    /// Frames wait for their turn.
    virtual bool queues() const { return true; }
    /// Stations listen: they are told what they sense and what they receive, and a unicast that
    /// nobody answers is repeated.
    virtual bool listens() const { return false; }
    /// Nodes that will sense a frame that is on air now.
    virtual void sensed(std::span<const Sensing> /*nodes*/) {}
    /// A frame ended at `node` and was received, or had errors.
    virtual void received(Air& /*air*/, NodeId /*node*/, const AirFrame& /*frame*/) {}
    virtual void missed(Air& /*air*/, NodeId /*node*/) {}
    /// True if `frame` is a repetition of one that `node` has already.
    virtual bool is_repeated(NodeId /*node*/, const AirFrame& /*frame*/) { return false; }

    /// [bytes] that access adds to a message
    virtual std::uint32_t header() const { return 0; }
    /// The bit rate at which a frame goes. @param sender, receiver  rates of their radios; that of
    ///         the receiver counts if the frame is for one node
    virtual BitRate rate(const AirFrame& /*frame*/, BitRate sender, BitRate /*receiver*/) const {
        return sender;
    }
    /// Rates, beside those of the radios, at which frames may go.
    virtual std::span<const BitRate> own_rates() const { return {}; }
    /// The physical layer that its frames go by.
    virtual Phy phy() const { return Wifi{}; }
};

/// The settings of an access protocol.
template <class T>
concept MakesAccess = std::copyable<T> && requires(const T& settings) {
    { T::name } -> std::convertible_to<std::string_view>;
    { settings.make_access() } -> std::same_as<std::unique_ptr<Access>>;
};

/// Any access protocol's settings, held by value: how nodes get access to the medium.
class AccessModel {
  public:
    template <class T>
    requires(!std::same_as<T, AccessModel> && MakesAccess<T>) AccessModel(T settings)
        : name_(T::name),
          make_([settings = std::move(settings)] { return settings.make_access(); }) {}

    std::string_view name() const { return name_; }

    /// A protocol for one Network.
    std::unique_ptr<Access> make_access() const { return make_(); }
    /// As its protocols do.
    bool listens() const { return make_access()->listens(); }
    Phy phy() const { return make_access()->phy(); }

  private:
    std::string_view name_;
    std::function<std::unique_ptr<Access>()> make_;
};

}  // namespace rovernet
