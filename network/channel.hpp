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

/// Some receptions of a frame, in order of time and then of node; it is now when the last ends.
struct Arriving {
    std::span<Reception> receptions;
    std::span<const Dbm> levels;  ///< received power of each, if somebody wants it
    bool undisturbed;             ///< all that are on get the frame without errors
};

/// What the channel tells the layer above.
class ChannelUser {
  public:
    /// The frame arrives at some of its receivers.
    virtual void arrived(const AirFrame& frame, const Arriving& part) = 0;
    /// These nodes will sense a frame that is on air now.
    virtual void sensed(std::span<const Sensing> nodes) = 0;

  protected:
    ~ChannelUser() = default;
};

/// Carries frames from those who send to those who can decode them, and decides what becomes of
/// them there.
class Channel {
  public:
    Channel(World& world, ChannelUser& user);

    /// How a frame goes on air.
    struct Sending {
        Duration airtime;
        BitRate rate;
        bool is_sensed;  ///< tells all who sense it
    };
    /// Puts a frame on air now. @return those who can decode it; good until the next call
    std::span<const Reception> transmit(const AirFrame& frame, const Sending& how);
    /// Serves the event of a frame.
    void arrive(const Event& event);

    /// The node, the last one, has just been added and stands on `leg`.
    void added(NodeId node, const Leg& leg);
    /// The node's leg or radio is about to change; it is `on` until now.
    void before_change(NodeId node, bool on);
    /// The node moves along `leg` from now on.
    void goes(NodeId node, const Leg& leg);

    /// @throws std::invalid_argument for a bit rate that receptions cannot be judged at
    void check(BitRate rate) const;
    /// See Network::interference_left_out.
    std::optional<Db> interference_left_out() const;

  private:
    /// A frame on its way to its receivers, some of which it may have reached already.
    struct Flight {
        AirFrame air;
        std::uint64_t emission = 0;  // its serial, if there is interference
        Medium::Receivers receivers;
        std::vector<Dbm> levels;  // of the receptions, if somebody wants them
        std::size_t arrived = 0;
        bool undisturbed = false;
    };

    void find_sensors(Flight& flight, Time end);
    void put_on_air(std::size_t slot, const Sending& how);
    void find_levels(Flight& flight, Time end);
    void forget_frames();
    void garble(Flight& flight) const;
    Time served_until(EventKey key) const;
    std::span<Reception> next_of(Flight& flight, EventKey key) const;

    World& world_;
    ChannelUser& user_;
    Slots<Flight> flights_;
    std::vector<Sensing> sensed_;               // of a frame
    std::optional<Interference> interference_;  // if the reception model has judges
};

}  // namespace rovernet
