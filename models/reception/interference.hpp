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

namespace rovernet {

/// What a receiver may get beside the frame that it decodes: the frames on air, their levels there,
/// and what nodes were when those frames began.
class Interference {
  public:
    struct Settings {
        Medium* medium = nullptr;       ///< not null; outlives this
        const Legs* legs = nullptr;     ///< not null; outlives this; the same nodes as the medium
        const Phy* phy = nullptr;       ///< not null; outlives this
        bool all_frames = false;        ///< looks at every frame on air, for tests
        std::uint64_t seed = 1;         ///< of random draws
        std::uint32_t replication = 0;  ///< of random draws
    };

    Interference(const Settings& settings, std::unique_ptr<Judge> judge)
        : settings_(settings), judge_(std::move(judge)) {}

    /// The node moves along `leg` from now on.
    void goes(NodeId node, const Leg& leg);
    /// The node's leg or radio is about to change; it is `on` until now.
    void before_change(NodeId node, bool on) {
        on_air_.changes(node, settings_.legs->leg(node), on);
    }

    /// The frame that Medium found the receivers of last goes on air. @return its serial
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
    /// Decides what becomes of receptions of the frame with that serial, which end by `now`.
    void judge(std::uint64_t serial, std::span<Reception> receptions, Time now);

    const Judge& rule() const { return *judge_; }

    // For the judge.
    const Medium& medium() const { return *settings_.medium; }
    /// A frame as it arrives at a node; nothing if the node does not notice it.
    std::optional<Arrival> arrival(const Emission& frame, NodeId node);
    /// Received power [dBm] at `node` of a frame whose level was left open.
    Dbm level(const Arrival& arrival, NodeId node) const {
        return settings_.medium->level(arrival, node);
    }
    /// The level of `frame` at `node` is that of `other` and `by` more, or higher.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId node) {
        return settings_.medium->is_stronger(frame, other, by, node);
    }
    /// [ns] No frame takes longer to anybody.
    Duration longest_delay() const { return settings_.medium->delay(on_air_.reach()); }
    /// A uniform draw in (0, 1), of the pair and of the sender's `number`-th frame.
    double draw(Purpose purpose, NodeId from, NodeId to, std::uint64_t number) const;
    std::uint64_t key(NodeId node) const { return settings_.medium->key(node); }

  private:
    Settings settings_;
    std::unique_ptr<Judge> judge_;
    OnAir on_air_;
    std::vector<const Emission*> all_;  // that the frame which is judged may meet
};

}  // namespace rovernet
