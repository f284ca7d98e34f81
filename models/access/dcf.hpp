// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/access/backoff.hpp"
#include "models/phy/wifi.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

// Carrier sense multiple access as in Wi-Fi. In code:
//
//     Network network({.reception = Sinr{}, .access = Csma{.rts_threshold = 500}});

namespace rovernet {

/// Rule by which a station waits longer than a DIFS (EIFS: room for an acknowledgement that it
/// would not understand) after a frame that it did not get.
///
/// - standard: after a frame that it had begun to receive, until a frame without errors ends;
///   802.11-2020, 10.3.2.3.7
/// - ns2: after each frame that it sensed, decodable or not, unless it is sending then; it is a
///   reservation, so that a DIFS follows, and no other frame ends it
/// - none: never
enum class EifsRule { standard, ns2, none };
/// Words of [access] eifs.
template <>
struct EnumNames<EifsRule> {
    static constexpr std::array<std::string_view, 3> values = {"standard", "ns2", "none"};
};

/// Times of a standard as ns-2.35 has them: energy is sensed at once, a station sends as it
/// decides, and a backoff has 0 to CW - 1 slots.
constexpr WifiTiming ns2_timing(WifiTiming timing) {
    timing.cca_time = timing.turnaround = Duration{0};
    --timing.cw_min;
    --timing.cw_max;
    return timing;
}

/// Settings of the 802.11 DCF. Defaults are those of 802.11b.
struct Csma {
    static constexpr std::string_view name = "csma";

    /// Standard, which gives airtimes, and its timing.
    WifiStandard standard = WifiStandard::b;
    /// Times of the access, by default the standard's.
    WifiTiming timing = timing_of(WifiStandard::b);
    /// Basic rates [bit/s]: broadcasts and RTS go at the lowest, an answer at the highest that is
    /// not above the rate of what it answers (the lowest, if all are above). Not empty; in any
    /// order.
    std::vector<BitRate> basic_rates = mandatory_rates(WifiStandard::b);
    /// Frames after which stations wait longer.
    EifsRule eifs = EifsRule::standard;
    /// Attempts of an RTS, or of data without one; 0: no end.
    int short_retries = 7;
    /// Attempts of data behind an RTS; 0: no end.
    int long_retries = 4;
    /// Size [bytes], header included, above which a unicast asks with an RTS first.
    std::uint32_t rts_threshold = 2347;
    /// Size [bytes] that access adds to a message.
    std::uint32_t header = data_header_bytes;
    /// Frames that wait at a node at most; one more is dropped.
    std::uint32_t queue = 50;

    /// Model at work, for one Network.
    /// @throws std::invalid_argument if a slot is not > 0, or there is no basic rate
    std::unique_ptr<Access> make_access() const;
};

/// Access model "csma": the distributed coordination function of IEEE 802.11, for broadcasts and
/// unicasts, for all stations.
///
///   sender    | DIFS | backoff |=== data ===|      |     |
///   receiver  |                             | SIFS |=ACK=|
///   others    |                |   energy   | reserved   | DIFS | backoff ...
///
/// A station that has a frame waits for a DIFS and, if the medium was busy, for a backoff of 0 to
/// CW slots. A broadcast is not answered. A unicast is acknowledged after a SIFS; without an
/// acknowledgement it is repeated with a doubled window, up to the limit of retries. A large one
/// asks with an RTS, which the receiver answers by a CTS; both reserve the medium (NAV).
///
/// A station has one timer at most, and only while it has a frame: for its access, or for the
/// answer that it waits for. What it senses is written into its Backoff as it is sent; a timer that
/// finds that the medium was busy in the meantime is set again.
///
/// Source: IEEE 802.11-2020, 10.3.
class Dcf final : public Access {
  public:
    /// @throws std::invalid_argument if a slot is not > 0, or there is no basic rate
    explicit Dcf(const Csma& settings);

    /// Copies are forbidden: backoffs refer to the timing.
    Dcf(const Dcf&) = delete;
    Dcf& operator=(const Dcf&) = delete;

    void add() override;
    void send(Air& air, const QueuedFrame& frame) override;
    void on_timer(Air& air, NodeId node, std::uint32_t tag) override;
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) override;
    void switch_off(Air& air, NodeId node) override;

    bool listens() const override { return true; }
    void sensed(Air& air, std::span<const Sensing> nodes) override;
    void received(Air& air, NodeId node, const AirFrame& frame) override;
    void missed(Air& air, NodeId node, bool locked) override;
    bool is_repeated(NodeId node, const AirFrame& frame) override;

    std::uint32_t header() const override { return settings_.header; }
    BitRate rate(const AirFrame& frame, BitRate sender, BitRate receiver) const override;
    std::span<const BitRate> own_rates() const override { return settings_.basic_rates; }
    Phy phy() const override { return Wifi{.framing = settings_.standard}; }

  private:
    /// State of a station: without a frame, waiting for access, or for an answer.
    enum class State : std::uint8_t { idle, contending, awaiting_cts, awaiting_ack };
    /// Tag of a timer: for access, for an answer that may be missing, and for an answer to send.
    enum Tag : std::uint32_t { access, answer, response };

    /// Last data frame that a station has from a sender, by its number.
    struct Heard {
        NodeId from;
        std::uint32_t number;
    };
    /// Part of a station that every frame on air changes: one cache line.
    struct alignas(64) Listening {
        Backoff backoff;
        /// End of what the station senses.
        Time on_air_until = start_of_run;
    };
    /// State of a station beside that.
    struct Station {
        /// What it waits for.
        State state = State::idle;
        /// A backoff was drawn since its last frame.
        bool backing_off = false;
        /// It contends without having drawn a backoff: the medium was idle (immediate access).
        bool fresh = false;
        /// Its RTS was answered by a CTS.
        bool asked = false;
        /// Contention window [slots].
        int window = 0;
        /// Failed attempts: of an RTS or of data without one, and of data behind an RTS.
        int short_count = 0, long_count = 0;
        /// Number of its data frame, the same for all attempts.
        std::uint32_t number = 0;
        /// Draws so far.
        std::uint64_t draws = 0;
        /// Timer that counts; others are void.
        Time timer = never;
        /// Time until which others have reserved the medium (NAV).
        Time reserved_until = start_of_run;
        /// End of its own last frame.
        Time sends_until = start_of_run;
        /// Frames that wait; the first is being sent.
        std::vector<QueuedFrame> queue = {};
        /// Last number of each sender of unicasts.
        std::vector<Heard> heard = {};
        /// Answer that is due after a SIFS.
        std::optional<AirFrame> response = {};
    };

    // Bit rate of a CTS or an ACK that answers a frame of this rate.
    BitRate answer_rate(BitRate rate) const;
    Station& at(NodeId node) { return stations_[node.index()]; }
    Backoff& backoff(NodeId node) { return listening_[node.index()].backoff; }
    // First frame of the queue, as it goes on air.
    AirFrame data_frame(NodeId node) const;
    // Control frame of a kind, without its reservation.
    static AirFrame control_frame(NodeId from, NodeId to, AirFrame::Kind kind);
    // Asks for the medium for the first frame of the queue.
    void contend(Air& air, NodeId node);
    // Sets the one timer of a station; an older one is void.
    void set_timer(Air& air, NodeId node, Time t, Tag tag);
    // Draws a backoff, which counts from `from` on.
    void draw_backoff(Air& air, NodeId node, Time from);
    // Sends the first frame of the queue, or an RTS for it.
    void transmit_head(Air& air, NodeId node);
    // Sends the first frame of the queue; a unicast then waits for its acknowledgement.
    void transmit_data(Air& air, NodeId node);
    // Puts a frame on air. @return when it ends
    Time transmit(Air& air, const AirFrame& frame);
    // Waits for the answer to a frame that ends at `end`.
    void await(Air& air, NodeId node, Time end, State state);
    // Repeats a frame that was not answered, or gives it up.
    void answer_missing(Air& air, NodeId node);
    // Answers a frame for this node that has ended.
    void answer_to(Air& air, NodeId node, const AirFrame& frame);
    // Ends the work on the first frame: sent, or lost for a reason. A backoff begins behind it.
    void finish(Air& air, NodeId node, Time end, std::optional<DropReason> reason);
    // Keeps the station from sending until others that reserved the medium are done (NAV).
    void reserve(NodeId node, Time from, Time until);
    // EIFS of a station [ns].
    Duration eifs(const Air& air, NodeId node) const;
    // EIFS of ns-2 behind a frame that ends at `end`.
    void defer_as_ns2(const Air& air, NodeId node, Time end);
    // Sends a frame after a SIFS, whatever the medium is like.
    void respond(Air& air, NodeId node, const AirFrame& frame);
    // Sends the answer that is due.
    void send_response(Air& air, NodeId node);

    // Settings, the basic rates in order.
    Csma settings_;
    // Stations by node; a deque does not move them as it grows.
    std::deque<Station> stations_;
    // Backoffs by node.
    std::vector<Listening> listening_;
};

}  // namespace rovernet
