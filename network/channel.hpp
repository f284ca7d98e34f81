// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/interference.hpp"
#include "network/occurrence.hpp"
#include "sim/legs.hpp"
#include "sim/message.hpp"
#include "sim/record.hpp"
#include "sim/slots.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

struct World;

/// Group of receptions of one frame that the channel passes up in one call, in order of time and
/// then of node. World::now is the time of the last reception. The spans are valid only during the
/// call.
struct Arriving {
    /// Receptions of the group. The channel and the reception model have set each fate; higher
    /// layers may change the fate.
    std::span<Reception> receptions;
    /// Received power of each reception [dBm]; NaN at nodes for which the power is not requested.
    /// Empty if the power is requested at no receiver of the frame.
    std::span<const Dbm> levels;
    /// True if no reception can have errors, neither by interference nor by the sender's success
    /// rate.
    bool error_free;
};

/// Nodes for which the channel has to simulate the arrival of a frame.
enum class Audience {
    next_hop,   ///< only the next hop of a unicast: no other node reacts to the frame
    receivers,  ///< nodes that can decode the frame
    sensors,    ///< nodes that can sense the frame, for an access model that listens
};

/// Interface of the layer above the channel. Mac implements it.
class ChannelUser {
  public:
    /// Called when the frame ends at some of its receivers, once for each group of receptions.
    virtual void frame_ended(const AirFrame& frame, const Arriving& part) = 0;
    /// Called from Channel::transmit with the nodes that sense the new frame, and the frame's begin
    /// and end at each of these nodes.
    virtual void sensed(std::span<const Sensing> nodes) = 0;

  protected:
    ~ChannelUser() = default;
};

/// Radio channel: carries each frame from its transmitter to the receivers that can decode the
/// frame, and sets the fate of the frame at each receiver.
///
///   sender       |==== frame ====|
///   receiver 1     |==== frame ====|            delay by distance
///   receiver 2        |==== frame ====|
///                                  ^  ^         ends: one event, if no other event is between
///
/// Receivers and times of arrival are fixed when a frame starts; later movements do not change
/// them. The frame then becomes a Flight with one event, due when the frame ends at its first
/// receiver. The event serves all receptions that end before the next event in the queue. If the
/// reception model has a Judge, the frames on air are stored in Interference.
class Channel {
  public:
    /// @param user  layer above, which may still be under construction
    Channel(World& world, ChannelUser& user);

    /// Starts to transmit a frame now. The frame holds a reference to its message until the last
    /// reception.
    /// @param audience  nodes for which the arrival is simulated; for `sensors`,
    /// ChannelUser::sensed is called
    /// @return receptions at the nodes of the audience that can decode the frame, in order of time
    ///         and then of node; possibly others, too; valid until the next call
    std::span<const Reception> transmit(const AirFrame& frame, const Transmission& how,
                                        Audience audience);
    /// Serves the event of a frame: passes the receptions that end before the next event in the
    /// queue to the layer above, and queues the event again for the remaining receptions.
    void arrive(const Event& event);

    /// Adds a node, the last one in the world, whose first leg is `leg`.
    void added(NodeId node, const Leg& leg);
    /// Called before the node's leg or radio changes in Legs or Medium, so that interference of
    /// frames already on air is computed with the old leg and radio.
    /// @param on  whether the node's radio is on before the change
    void before_change(NodeId node, bool on);
    /// Reports the node's new leg, which begins now, to Interference, for bounds on speeds and
    /// antenna positions.
    void goes(NodeId node, const Leg& leg);

    /// Checks a bit rate that a robot or the access model may use.
    /// @throws std::invalid_argument if the reception model cannot judge receptions at this rate
    void check(BitRate rate) const;
    /// Upper bound [dB] on the reduction of any SINR so far by neglected interference, see
    /// Network::interference_left_out.
    std::optional<Db> interference_left_out() const;

  private:
    /// Frame in flight; some receivers may already have received it.
    struct Flight {
        AirFrame air;
        /// Serial number of the frame among those that may interfere, if the reception model
        /// considers interference (see Interference, Judge).
        std::uint64_t emission = 0;
        /// Receptions of the frame, in order of time; the first `served` of them have been served.
        Medium::Receivers receivers;
        /// Received power of each reception [dBm], see Arriving::levels.
        std::vector<Dbm> levels;
        std::size_t served = 0;
        bool error_free = false;
    };

    // Finds the receivers of the frame that belong to the audience.
    void find_receivers(Flight& flight, const Transmission& how, Audience audience);
    // Finds the receivers of the frame and all nodes that sense the frame; reports the sensing
    // nodes by ChannelUser::sensed.
    void find_sensors(Flight& flight, const Transmission& how);
    // Frame of a Flight that starts now, for levels and interference; without its reach.
    Emission emission_of(const Flight& flight, Time end) const;
    // Adds the frame of the Flight in `slot` to the frames that may interfere with other frames.
    void put_on_air(std::size_t slot, const Transmission& how);
    // Computes the received power of the frame at each receiver for which the power is requested.
    void find_levels(Flight& flight, Time end);
    // Frees the Flights of frames that cannot interfere with other frames any more.
    void forget_frames();
    // Marks random receptions as garbled, according to the sender's success rate.
    void garble(Flight& flight);
    // Time up to which the event with this key may serve receptions: the next event in the queue is
    // not before this time.
    Time served_until(EventKey key) const;
    // Receptions of a Flight that the event with this key serves next; sets World::now to the time
    // of the last of these receptions.
    std::span<Reception> next_of(Flight& flight, EventKey key) const;

    World& world_;
    ChannelUser& user_;
    // Frames in flight. If the reception model has a Judge, a slot is kept while its frame may
    // interfere with other frames.
    Slots<Flight> flights_;
    // By sender with a success rate < 1: number of frames that the routing protocol sent to one
    // node.
    std::vector<std::uint32_t> unicasts_;
    // Nodes that sense one frame; kept to reuse its memory.
    std::vector<Sensing> sensed_;
    // Frames on air, and the Judge of the reception model; empty if the model has no Judge.
    std::optional<Interference> interference_;
};

}  // namespace rovernet
