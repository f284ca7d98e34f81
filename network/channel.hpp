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

/// Group of receptions of a frame that are served together, in order of time and then of node.
/// World::now is the end of the last one. Pointers are valid only during the call.
struct Arriving {
    /// Receptions with the fate set by channel and reception model; higher layers may change it.
    std::span<Reception> receptions;
    /// Received power of each reception [dBm], NaN at nodes that do not ask for it; may be empty.
    std::span<const Dbm> levels;
    /// True if no reception can have errors, neither by interference nor by the sender's success
    /// rate.
    bool error_free;
};

/// Interface of the layer above the channel. Mac implements it.
class ChannelUser {
  public:
    /// Called when the frame ends at some of its receivers, once for each group of receptions.
    virtual void frame_ended(const AirFrame& frame, const Arriving& part) = 0;
    /// Called from transmit() with the nodes that sense the new frame, and the times between which
    /// they do.
    virtual void sensed(std::span<const Sensing> nodes) = 0;

  protected:
    ~ChannelUser() = default;
};

/// Channel: carries frames from transmitters to the receivers that can decode them, and sets their
/// fate there.
///
///   sender       |==== frame ====|
///   receiver 1     |==== frame ====|            delay by distance
///   receiver 2        |==== frame ====|
///                                  ^  ^         ends: one event, if no other event is between
///
/// Receivers and times of arrival are fixed when a frame starts, whatever moves later. The frame is
/// then a Flight with one event, due when the frame ends at its first receiver; the event serves
/// all receptions until the next other event. If the reception model has a Judge, Interference uses
/// the frames on air.
class Channel {
  public:
    /// @param user  layer above, which may still be under construction
    Channel(World& world, ChannelUser& user);

    /// Starts to transmit a frame now. The frame holds a reference to its message until the last
    /// reception.
    /// @param is_sensed  the access model uses carrier sensing: sensed() reports the nodes that
    /// sense
    ///                   the frame
    /// @return receptions at the nodes that can decode it, in order; valid until the next call
    std::span<const Reception> transmit(const AirFrame& frame, const Transmission& how,
                                        bool is_sensed);
    /// Serves the event of a frame: passes the receptions that end now to the layer above, and
    /// queues the event again for the rest.
    void arrive(const Event& event);

    /// Adds the last node of the world, which starts on `leg`.
    void added(NodeId node, const Leg& leg);
    /// Called before the node's leg or radio changes in Legs or Medium: frames on air are judged by
    /// the old state.
    /// @param on  whether the node is on until now
    void before_change(NodeId node, bool on);
    /// Sets a new leg of the node, which begins now.
    void goes(NodeId node, const Leg& leg);

    /// Checks a bit rate that a robot or the access model may use.
    /// @throws std::invalid_argument if the reception model cannot judge receptions at this rate
    void check(BitRate rate) const;
    /// Upper bound on the SINR reduction by neglected interference so far, see
    /// Network::interference_left_out.
    std::optional<Db> interference_left_out() const;

  private:
    /// Frame in flight; some receivers may already have received it.
    struct Flight {
        AirFrame air;
        /// Serial number of the frame in Interference, if the network has one.
        std::uint64_t emission = 0;
        /// Receptions of the frame, in order of time; the first `served` of them have been served.
        Medium::Receivers receivers;
        /// Received power of each reception [dBm], as in Arriving.
        std::vector<Dbm> levels;
        std::size_t served = 0;
        bool error_free = false;
    };

    // Finds all nodes that sense the frame, with the receivers, and reports them.
    void find_sensors(Flight& flight, const Transmission& how);
    // Adds the frame to the frames that may interfere.
    void put_on_air(std::size_t slot, const Transmission& how);
    // Sets the received power of each reception at a node that asks for it.
    void find_levels(Flight& flight, Time end);
    // Frees the flights of frames that cannot interfere any more.
    void forget_frames();
    // Marks receptions as garbled by the sender's success rate.
    void garble(Flight& flight) const;
    // Time up to which receptions can be served together, without another event between.
    Time served_until(EventKey key) const;
    // Next receptions to serve; sets World::now to the end of the last one.
    std::span<Reception> next_of(Flight& flight, EventKey key) const;

    World& world_;
    ChannelUser& user_;
    // Frames in flight. With interference a slot is kept while the frame may affect other frames.
    Slots<Flight> flights_;
    // Nodes that sense one frame; kept to reuse its memory.
    std::vector<Sensing> sensed_;
    // Frames on air and their judge, if the reception model has one.
    std::optional<Interference> interference_;
};

}  // namespace rovernet
