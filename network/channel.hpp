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
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rovernet {

struct World;

/// Part of a frame's receptions that is served at once, in order of time and then of node.
/// World::now is when the last of them ends. All that it points to is good during the call only.
struct Arriving {
    /// Receptions with the fate that channel and reception model gave them; the layers above change
    /// it.
    std::span<Reception> receptions;
    /// Received power of each [dBm]; empty unless somebody wants it.
    std::span<const Dbm> levels;
    /// No reception has errors: neither interference nor the sender's success rate takes any.
    bool error_free;
};

/// Layer above the channel, as the channel knows it. Mac is one.
class ChannelUser {
  public:
    /// Tells that the frame ends at some of its receivers; there is one call for each part.
    virtual void arrived(const AirFrame& frame, const Arriving& part) = 0;
    /// Tells which nodes sense a frame that goes on air now, and from when until when. Called from
    /// within transmit().
    virtual void sensed(std::span<const Sensing> nodes) = 0;

  protected:
    ~ChannelUser() = default;
};

/// Channel: carries frames from those who send to those who can decode them, and decides what
/// becomes of them there.
///
///   sender       |==== frame ====|
///   receiver 1     |==== frame ====|            delay by distance
///   receiver 2        |==== frame ====|
///                                  ^  ^         ends: one event, if nothing is due between
///
/// Who can decode a frame, and when it ends there, is fixed as it goes on air, whatever moves
/// later. The frame is then a Flight with one event, which is due when it ends at its first
/// receiver; the event serves as many receptions as nothing else comes between. Interference looks
/// at the frames on air, if the reception model has a Judge.
class Channel {
  public:
    /// @param user  layer above, which may still be under construction
    Channel(World& world, ChannelUser& user);

    /// Way in which a frame goes on air, as the access model wants it.
    struct Sending {
        /// Time on air [ns], > 0.
        Duration airtime;
        /// Rate of its bits [bit/s], for the reception model.
        BitRate rate;
        /// The access model listens: all who sense the frame are told.
        bool is_sensed;
    };
    /// Puts a frame on air now. It holds the frame's message until the last reception.
    /// @return receptions of those who can decode it, in order; good until the next call
    std::span<const Reception> transmit(const AirFrame& frame, const Sending& how);
    /// Serves the event of a frame: tells the user of the receptions that end now, and queues the
    /// event again for the rest.
    void arrive(const Event& event);

    /// Takes note of a node that has just been added, the last one, and stands on `leg`.
    void added(NodeId node, const Leg& leg);
    /// Takes note that the node's leg or radio is about to change: frames on air are judged by what
    /// it was. Called before the change is written to Legs or Medium.
    /// @param on  whether it is on until now
    void before_change(NodeId node, bool on);
    /// Takes note that the node moves along `leg` from now on.
    void goes(NodeId node, const Leg& leg);

    /// Checks a bit rate that some robot or the access model may send at.
    /// @throws std::invalid_argument for one whose receptions the reception model cannot judge
    void check(BitRate rate) const;
    /// Bound on what the interference left out would take off a ratio so far, see
    /// Network::interference_left_out.
    std::optional<Db> interference_left_out() const;

  private:
    /// Frame on its way to its receivers, some of which it may have reached already.
    struct Flight {
        AirFrame air;
        /// Serial of the frame in Interference, if there is one.
        std::uint64_t emission = 0;
        /// Receptions, sorted; the first `arrived` of them have been served.
        Medium::Receivers receivers;
        /// Received power of each reception [dBm], if somebody wants it.
        std::vector<Dbm> levels;
        std::size_t arrived = 0;
        bool error_free = false;
    };

    // Finds receivers, and tells all that sense the frame.
    void find_sensors(Flight& flight, Time end);
    // Adds the frame to those that may interfere with one another.
    void put_on_air(std::size_t slot, const Sending& how);
    // Fills in the received power of each reception.
    void find_levels(Flight& flight, Time end);
    // Frees the flights of frames that matter to no other any more.
    void forget_frames();
    // Gives receptions errors by the sender's success rate.
    void garble(Flight& flight) const;
    // Time up to which receptions can be served in a row, without an event in between.
    Time served_until(EventKey key) const;
    // Receptions that are served next; sets World::now to the end of the last.
    std::span<Reception> next_of(Flight& flight, EventKey key) const;

    World& world_;
    ChannelUser& user_;
    // Frames in flight. With interference a slot is kept until the frame matters to no other.
    Slots<Flight> flights_;
    // Nodes that sense one frame; kept for its memory.
    std::vector<Sensing> sensed_;
    // Frames on air and their judge, if the reception model has one.
    std::optional<Interference> interference_;
};

}  // namespace rovernet
