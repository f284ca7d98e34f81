// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "models/access/backoff.hpp"
#include "models/phy/wifi.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet {

/// How stations of the 802.11 DCF behave.
struct Csma {
    static constexpr std::string_view name = "csma";

    WifiStandard standard = WifiStandard::b;
    WifiTiming timing = timing_of(WifiStandard::b);
    /// Broadcasts and RTS go at the lowest, an answer at the highest that is not above the rate of
    /// what it answers (the lowest, if all are above). Not empty; in any order.
    std::vector<BitRate> basic_rates = mandatory_rates(WifiStandard::b);
    bool eifs = true;                    ///< wait longer after a frame with errors
    int short_retries = 7;               ///< attempts of an RTS, or of data without; 0: no end
    int long_retries = 4;                ///< attempts of data behind an RTS; 0: no end
    std::uint32_t rts_threshold = 2347;  ///< [bytes] unicasts of more, header included, ask first
    std::uint32_t header = data_header_bytes;  ///< [bytes] that access adds to a message
    std::uint32_t queue = 50;                  ///< frames that wait at most; more are dropped

    /// @throws std::invalid_argument if a slot is not > 0, or there is no basic rate
    std::unique_ptr<Access> make_access() const;
};

/// Access model "csma": the distributed coordination function of IEEE 802.11, for broadcasts and
/// unicasts, for all stations.
///
/// A station has one timer at most, and only while it has a frame: for its access, or for the
/// answer that it waits for. What it senses is written into its Backoff as it is sent; a timer that
/// finds that the medium was busy in the meantime is set again. Source: IEEE 802.11-2020, 10.3.
class Dcf final : public Access {
  public:
    /// @throws std::invalid_argument if a slot is not > 0, or there is no basic rate
    explicit Dcf(const Csma& settings);

    Dcf(const Dcf&) = delete;  // backoffs refer to the timing
    Dcf& operator=(const Dcf&) = delete;

    void add() override;
    void send(Air& air, const QueuedFrame& frame) override;
    void on_timer(Air& air, NodeId node, std::uint32_t tag) override;
    std::vector<QueuedFrame> take(NodeId node, NodeId next_hop) override;
    void switch_off(Air& air, NodeId node) override;

    bool listens() const override { return true; }
    void sensed(std::span<const Sensing> nodes) override;
    void received(Air& air, NodeId node, const AirFrame& frame) override;
    void missed(Air& air, NodeId node) override;
    bool is_repeated(NodeId node, const AirFrame& frame) override;

    std::uint32_t header() const override { return settings_.header; }
    BitRate rate(const AirFrame& frame, BitRate sender, BitRate receiver) const override;
    std::span<const BitRate> own_rates() const override { return settings_.basic_rates; }
    Phy phy() const override { return Wifi{.framing = settings_.standard}; }

  private:
    enum class State : std::uint8_t { idle, contending, awaiting_cts, awaiting_ack };
    enum Tag : std::uint32_t { access, answer, response };

    struct Heard {
        NodeId from;
        std::uint32_t number;
    };
    /// What every frame on air changes: as little as possible, for the caches' sake.
    struct alignas(64) Listening {
        Backoff backoff;
        Time on_air_until = start_of_run;  // what it senses
    };
    struct Station {
        State state = State::idle;
        bool backing_off = false;             // a backoff was drawn since its last frame
        bool fresh = false;                   // contends without having drawn one
        bool asked = false;                   // its RTS was answered
        int window = 0;                       // contention window [slots]
        int short_count = 0, long_count = 0;  // failed attempts
        std::uint32_t number = 0;             // of its data frame
        std::uint64_t draws = 0;
        Time timer = never;                  // the one that counts
        Time reserved_until = start_of_run;  // by others: its NAV
        std::vector<QueuedFrame> queue = {};
        std::vector<Heard> heard = {};          // the last number of each sender of unicasts
        std::optional<AirFrame> response = {};  // due after a SIFS
    };

    /// The bit rate of a CTS or an ACK. @param rate  of the frame that it answers
    BitRate answer_rate(BitRate rate) const;
    Station& at(NodeId node) { return stations_[node.index()]; }
    Backoff& backoff(NodeId node) { return listening_[node.index()].backoff; }
    AirFrame data_frame(NodeId node) const;
    static AirFrame control_frame(NodeId from, NodeId to, AirFrame::Kind kind);
    void contend(Air& air, NodeId node);
    void set_timer(Air& air, NodeId node, Time t, Tag tag);
    void draw_backoff(Air& air, NodeId node, Time from);
    void transmit_head(Air& air, NodeId node);
    void transmit_data(Air& air, NodeId node);
    Time transmit(Air& air, const AirFrame& frame);
    void await(Air& air, NodeId node, Time end, State state);
    void answer_missing(Air& air, NodeId node);
    void answer_to(Air& air, NodeId node, const AirFrame& frame);
    void finish(Air& air, NodeId node, Time end, std::optional<DropReason> reason);
    void respond(Air& air, NodeId node, const AirFrame& frame);
    void send_response(Air& air, NodeId node);

    Csma settings_;
    std::deque<Station> stations_;
    std::vector<Listening> listening_;  // by node, as stations_
};

}  // namespace rovernet
