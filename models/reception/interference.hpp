// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium/medium.hpp"
#include "models/reception/judge.hpp"
#include "models/reception/on_air.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/random.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

// Interference between overlapping frames, the input of a Judge. The Channel reports transmissions,
// motion and switches to Interference, and calls judge() before it passes receptions up.

namespace rovernet {

/// Interference at receivers: frames on air, their levels at receivers, and the state of nodes when
/// the frames began. The Channel of a network has an Interference if the reception model has a
/// Judge.
///
/// Levels are computed only if a judge needs them, for the positions and radio states at the
/// beginning of the frame: later movements and switching have no effect on levels. The Channel
/// calls, in this order:
///
///   add(frame)                         when a frame starts
///   before_change(node), goes(node)    whenever a leg or a radio changes
///   judge(serial, receptions)          when a frame ends at some receivers
///   forget(now)                        before the next frame is added
class Interference {
  public:
    /// Inputs of the interference computation, and the seed of random draws.
    struct Settings {
        /// Medium that computes levels; not null; must outlive the Interference.
        Medium* medium = nullptr;
        /// Legs of the medium's nodes; not null; must outlive the Interference.
        const Legs* legs = nullptr;
        /// Physical layer of the frames; not null; must outlive the Interference.
        const Phy* phy = nullptr;
        /// Test mode: checks every frame on air instead of the frames nearby; slow.
        bool all_frames = false;
        /// Seed and replication of random draws.
        std::uint64_t seed = 1;
        std::uint32_t replication = 0;
    };

    /// @param judge  judge of the reception model; not null
    Interference(const Settings& settings, std::unique_ptr<Judge> judge)
        : settings_(settings), judge_(std::move(judge)) {}

    /// Reports a new leg of the node, which begins now.
    void goes(NodeId node, const Leg& leg);
    /// Stores the state of a node before its leg or radio changes.
    /// @param on  whether the node's radio was on until now
    void before_change(NodeId node, bool on) {
        on_air_.changes(node, settings_.legs->leg(node), on);
    }

    /// Adds a frame that starts now; `origin` and `heard_within` of the frame must be set.
    /// @param how         transmission parameters of the frame
    /// @param receptions  receptions at the nodes that can decode the frame, in order
    /// @return serial number of the frame
    std::uint64_t add(Emission frame, const Transmission& how,
                      std::span<const Reception> receptions);
    /// Removes the frames that cannot affect a reception from `now` on, except as earlier() frames;
    /// calls use(frame) for each.
    template <class Use>
    void forget(Time now, Use use) {
        // Let T be the longest airtime plus the longest delay. A reception that is still to be
        // judged began at most T ago. A frame that affects it began at most T before it.
        const Duration longest = longest_airtime() + longest_delay();
        const auto drop = [&](const Emission& frame) {
            judge_->is_forgotten(frame);
            use(frame);
        };
        on_air_.forget(now - 2 * longest, drop, judge_->airtimes_kept() * longest);
    }
    /// Sets the fate of the receptions of frame number `serial` that end at or before `now`.
    /// Receptions at nodes that are off are not changed.
    void judge(std::uint64_t serial, std::span<Reception> receptions, Time now);

    /// Judge of the reception model.
    const Judge& rule() const { return *judge_; }

    // Medium of the network; this function and the functions below are for the judge.
    const Medium& medium() const { return *settings_.medium; }
    /// Arrival of a frame at a node, without its level; empty if the frame has no effect at the
    /// node: the node is too far away, off, or in another network. A node's own frame arrives
    /// without a delay.
    std::optional<Arrival> arrival(const Emission& frame, NodeId node);
    /// Computes the received power [dBm] at `node` for an Arrival without a level (NaN).
    Dbm level(const Arrival& arrival, NodeId node) const {
        return settings_.medium->arrivals().level(arrival, node);
    }
    /// Whether the level of `frame` at `node` exceeds the level of `other` by `by` [dB] or more. A
    /// level is computed only if bounds on the levels do not decide.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId node) {
        return settings_.medium->arrivals().is_stronger(frame, other, by, node);
    }
    /// Frames that may have arrived at `node`, a receiver of `judged`, before `judged` did; the
    /// last one to start is first. They go back Judge::airtimes_kept() airtimes of the longest
    /// frame; only the other frames of Judge::judge() have a valid Emission::flight. Called by a
    /// judge during judge(). The result may contain further frames, and is valid until the next
    /// call.
    Frames earlier(const Emission& judged, NodeId node);
    /// Longest airtime of any frame so far [ns].
    Duration longest_airtime() const { return on_air_.longest(); }
    /// Physical layer of the frames.
    const Phy& phy() const { return *settings_.phy; }
    /// Longest propagation delay [ns] of any frame.
    Duration longest_delay() const { return settings_.medium->arrivals().delay(on_air_.reach()); }
    /// Uniform draw in (0, 1) for a pair of nodes and frame number `number` of the sender.
    double draw(Purpose purpose, NodeId from, NodeId to, std::uint64_t number) const;
    /// Key of a node, for orderings that do not depend on its id.
    std::uint64_t key(NodeId node) const { return settings_.medium->stations().key(node); }

  private:
    // Arrival of a frame at another node whose leg or radio may have changed since it began.
    std::optional<Arrival> arrival_before_change(const Emission& frame, NodeId node);
    // Arrival of a frame at a node other than its sender, with directional antennas.
    std::optional<Arrival> directional_arrival(const Emission& frame, NodeId node);

    Settings settings_;
    std::unique_ptr<Judge> judge_;
    // Frames on air, and states of nodes before their legs or radios changed.
    OnAir on_air_;
    // Frames that may overlap with the judged frame; kept to reuse the memory.
    std::vector<const Emission*> all_;
    // Result of earlier(), and whether it is that for a node without changes.
    std::vector<const Emission*> earlier_;
    std::optional<bool> earlier_is_near_;
};

}  // namespace rovernet
