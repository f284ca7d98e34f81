// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/access/backoff.hpp"
#include "models/access/csma.hpp"
#include "models/access/transmit_queue.hpp"
#include "models/phy/wifi.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>  // order never observed
#include <vector>

// Carrier sense multiple access as in Wi-Fi. In code:
//
//     Network network({.reception = Sinr{}, .access = Csma{.rts_threshold = 500}});

namespace rovernet {

/// Access model "csma": the distributed coordination function of IEEE 802.11, for broadcasts and
/// unicasts, for all stations.
///
///   sender    | DIFS | backoff |=== data ===|      |     |
///   receiver  |                             | SIFS |=ACK=|
///   others    |                |   energy   | reserved   | DIFS | backoff ...
///
/// A station with a frame waits for a DIFS and, if the medium was busy, for a backoff of 0 to CW
/// slots. A broadcast is not acknowledged. A unicast is acknowledged after a SIFS; without an
/// acknowledgement it is repeated with a doubled window, up to the retry limit. A large unicast is
/// preceded by an RTS, which the receiver answers with a CTS; both reserve the medium (NAV).
///
/// A station has at most one timer, and only while the station has a frame: a timer for channel
/// access, or for an expected response. The Backoff of a station gets each sensed frame when the
/// frame starts. If the medium was busy before the timer is due, the timer is set again.
///
/// Source: IEEE 802.11-2020, 10.3.
class Dcf final : public Access {
  public:
    /// @throws std::invalid_argument if the slot is not > 0, or there is no basic rate
    explicit Dcf(const Csma& settings);

    /// Not copyable, because backoffs refer to the timing.
    Dcf(const Dcf&) = delete;
    Dcf& operator=(const Dcf&) = delete;

    void add() override;
    void send(Air& air, const QueuedFrame& frame) override;
    void on_timer(Air& air, NodeId node, std::uint32_t tag) override;
    std::vector<QueuedFrame> take(NodeId node, const FrameTest& is_taken) override;
    std::size_t queued(NodeId node) const override { return stations_[node.index()].queue.size(); }
    void switch_off(Air& air, NodeId node) override;

    bool listens() const override { return true; }
    bool has_priority() const override { return settings_.priority; }
    void sensed(Air& air, std::span<const Sensing> nodes) override;
    void received(Air& air, NodeId node, const AirFrame& frame) override;
    void missed(Air& air, NodeId node, bool locked) override;
    bool is_repeated(NodeId node, const AirFrame& frame) override;

    std::uint32_t header() const override { return settings_.header.value; }
    BitRate rate(const AirFrame& frame, BitRate sender, BitRate receiver) const override;
    std::span<const BitRate> own_rates() const override { return settings_.rates; }
    Phy phy() const override { return Wifi{.framing = settings_.standard}; }

  private:
    /// State of a station: without a frame, contending for access, or waiting for a response.
    enum class State : std::uint8_t { idle, contending, awaiting_cts, awaiting_ack };
    /// Purpose of a timer: channel access, timeout of an expected response, sending of a response.
    enum Tag : std::uint32_t { access, answer, response };

    /// Carrier sensing of a station, updated by every sensed frame; fills one cache line.
    struct alignas(64) Listening {
        Backoff backoff;
        /// End of the last frame that the station senses.
        Time on_air_until = start_of_run;
    };
    /// State of a station, except for its carrier sensing (see Listening).
    struct Station {
        /// Current state of the station: idle, contending for access, or waiting for a response.
        State state = State::idle;
        /// True if a backoff was drawn since the station's last frame.
        bool backing_off = false;
        /// True if the station contends without a backoff, since the medium was idle.
        bool fresh = false;
        /// True if a CTS has answered the station's RTS.
        bool asked = false;
        /// Contention window [slots].
        int window = 0;
        /// Numbers of failed attempts: of an RTS or of data without RTS, and of data after an RTS.
        int short_count = 0, long_count = 0;
        /// Sequence number of the current data frame, the same for all attempts.
        std::uint32_t number = 0;
        /// Number of random draws of the station so far: index of the next draw.
        std::uint64_t draws = 0;
        /// Time of the station's valid timer; timers at other times are ignored.
        Time timer = never;
        /// End of the reservation of the medium by other stations (NAV).
        Time reserved_until = start_of_run;
        /// End of the last frame that the station transmitted.
        Time sends_until = start_of_run;
        /// Frames in the station's queue; the first is in transmission.
        TransmitQueue queue = {};
        /// Response that the station sends after a SIFS: CTS, ACK, or data after a CTS.
        std::optional<AirFrame> response = {};
    };

    // Bit rate of a CTS or ACK that answers a frame of this rate.
    BitRate answer_rate(BitRate rate) const;
    Station& at(NodeId node) { return stations_[node.index()]; }
    Backoff& backoff(NodeId node) { return listening_[node.index()].backoff; }
    // Data frame that transmits the first frame of the node's queue.
    AirFrame data_frame(NodeId node) const;
    // Control frame (RTS, CTS or ACK) of a kind, without a reservation of the medium.
    static AirFrame control_frame(NodeId from, NodeId to, const ControlFrame& kind);
    // Starts contention for the first frame of the queue.
    void contend(Air& air, NodeId node);
    // Sets the timer of a station; an older timer is then ignored.
    void set_timer(Air& air, NodeId node, Time t, Tag tag);
    // Begins the next frame: new sequence number; retry counts and window are reset.
    void next_frame(Station& station);
    // Draws a backoff whose slots count from `from` on.
    void draw_backoff(Air& air, NodeId node, Time from);
    // Transmits the first frame of the queue, or an RTS for it.
    void transmit_head(Air& air, NodeId node);
    // Transmits the first frame of the queue; for a unicast the station then waits for the ACK.
    void transmit_data(Air& air, NodeId node);
    // Transmits a frame. @return its end
    Time transmit(Air& air, const AirFrame& frame);
    // Sets the timeout for the response to a frame that ends at `end`.
    void await(Air& air, NodeId node, Time end, State state);
    // Retransmits the node's frame after a missing response, or drops it at the retry limit.
    void answer_missing(Air& air, NodeId node);
    // Handles a frame addressed to `node` that has ended there, and schedules its response.
    void answer_to(Air& air, NodeId node, const AirFrame& frame);
    // Removes the first frame of the queue and starts a backoff. The frame was sent; if `reason` is
    // given, the frame was lost.
    void finish(Air& air, NodeId node, Time end, std::optional<DropReason> reason);
    // Sets the NAV: the station does not send until reservations by other stations end.
    void reserve(NodeId node, Time from, Time until);
    // Duration of the EIFS of a station [ns].
    Duration eifs(const Air& air, NodeId node) const;
    // Applies the EIFS rule of ns-2 after a frame that ends at `end`.
    void defer_as_ns2(const Air& air, NodeId node, Time end);
    // Schedules the transmission of a response after a SIFS, without carrier sensing.
    void respond(Air& air, NodeId node, const AirFrame& frame);
    // Transmits the station's response, whose SIFS is over.
    void send_response(Air& air, NodeId node);

    // Settings with all defaults filled in; `rates` are the basic rates [bit/s], ascending.
    struct Settings : Csma {
        WifiTiming timing;
        std::vector<BitRate> rates;
        bool at_once;
    } settings_;
    // Stations by node; a deque, because its elements do not move when it grows.
    std::deque<Station> stations_;
    // Carrier sensing by node.
    std::vector<Listening> listening_;
    // Sequence number of the last unicast that a station received from a sender. Key: id of the
    // station in the upper 32 bits, id of the sender in the lower 32.
    std::unordered_map<std::uint64_t, std::uint32_t> last_numbers_;
};

}  // namespace rovernet
