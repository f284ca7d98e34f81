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

// Frames that overlap, as a Judge sees them. The channel tells what goes on air, what moves and
// what is switched; before a reception is handed up, it asks judge().

namespace rovernet {

/// Interference at receivers: the frames on air, their levels there, and what nodes were when those
/// frames began. The channel of a network has one if its reception model has a Judge.
///
/// Levels are fixed when a frame begins, and computed only when a judge asks for them. A receiver
/// that has moved or was switched since is looked at as it was then. What the channel calls, in
/// this order:
///
///   add(frame)                         as it goes on air
///   before_change(node), goes(node)    whenever a leg or a radio changes
///   judge(serial, receptions)          as it ends at some receivers
///   forget(now)                        before the next frame is added
class Interference {
  public:
    /// What it looks at, and the run's random draws.
    struct Settings {
        /// Medium that computes levels; not null; outlives this.
        Medium* medium = nullptr;
        /// Legs of the same nodes; not null; outlives this.
        const Legs* legs = nullptr;
        /// Physical layer of the frames; not null; outlives this.
        const Phy* phy = nullptr;
        /// It looks at every frame on air, instead of those nearby: slow, for tests.
        bool all_frames = false;
        /// Seed and replication of random draws.
        std::uint64_t seed = 1;
        std::uint32_t replication = 0;
    };

    /// @param judge  rule of the reception model; not null
    Interference(const Settings& settings, std::unique_ptr<Judge> judge)
        : settings_(settings), judge_(std::move(judge)) {}

    /// Takes note that the node moves along `leg` from now on.
    void goes(NodeId node, const Leg& leg);
    /// Takes note that the node's leg or radio is about to change; it is `on` until now.
    void before_change(NodeId node, bool on) {
        on_air_.changes(node, settings_.legs->leg(node), on);
    }

    /// Adds the frame that goes on air, whose receivers Medium found last.
    /// @param rate        of its payload [bit/s]
    /// @param receptions  of those who can decode it, in order
    /// @return its serial
    std::uint64_t add(Emission frame, BitRate rate, std::span<const Reception> receptions);
    /// Forgets the frames on which no judgement depends from `now` on; calls use(frame) for each.
    template <class Use>
    void forget(Time now, Use use) {
        // A reception may still be judged that began so long ago, and one that it depends on
        // before.
        const Duration matters = 2 * (on_air_.longest() + longest_delay());
        on_air_.forget(now - matters, [&](const Emission& frame) {
            judge_->is_forgotten(frame);
            use(frame);
        });
    }
    /// Decides the fate of receptions of the frame with that serial, which end by `now`; nodes that
    /// are off are left alone.
    void judge(std::uint64_t serial, std::span<Reception> receptions, Time now);

    /// Judge of the reception model.
    const Judge& rule() const { return *judge_; }

    // Functions for the judge.
    const Medium& medium() const { return *settings_.medium; }
    /// Frame as it arrives at a node, its level left open; nothing if the node does not notice it:
    /// it is too far away, off, or in another network. A node's own frame arrives without a delay.
    std::optional<Arrival> arrival(const Emission& frame, NodeId node);
    /// Received power [dBm] at `node` of a frame whose level was left open.
    Dbm level(const Arrival& arrival, NodeId node) const {
        return settings_.medium->arrivals().level(arrival, node);
    }
    /// Whether the level of `frame` at `node` exceeds that of `other` by `by` or more. It may find
    /// out by bounds, without the levels: these stay open then.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId node) {
        return settings_.medium->arrivals().is_stronger(frame, other, by, node);
    }
    /// Longest delay [ns] of any frame to anybody.
    Duration longest_delay() const { return settings_.medium->arrivals().delay(on_air_.reach()); }
    /// Uniform draw in (0, 1) of a pair and of the sender's `number`-th frame.
    double draw(Purpose purpose, NodeId from, NodeId to, std::uint64_t number) const;
    /// Key of a node, for orders that do not depend on its number.
    std::uint64_t key(NodeId node) const { return settings_.medium->stations().key(node); }

  private:
    // Frame as it arrives at a node that is not its sender, where antennas are directional.
    std::optional<Arrival> directional_arrival(const Emission& frame, NodeId node);

    Settings settings_;
    std::unique_ptr<Judge> judge_;
    // Frames on air, and what nodes were before they changed.
    OnAir on_air_;
    // Frames that the one which is judged may meet; kept for its memory.
    std::vector<const Emission*> all_;
};

}  // namespace rovernet
