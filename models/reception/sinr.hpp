// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/phy.hpp"
#include "models/reception/judge.hpp"
#include "sim/math.hpp"
#include "sim/record.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

// Reception by signal to interference and noise. In code:
//
//     Network network({.propagation = LogDistance{}, .reception = Sinr{.interference_cut =
//     Db{30}}});
//
// Settings, and the rule for one receiver; sinr_judge.cpp applies it to the frames of a network.

namespace rovernet {

/// Reception model "sinr": a receiver that is free locks on to a frame whose preamble it finds, and
/// gets it with the probability that all bits are right, chunk by chunk between the changes of the
/// interference, which is the sum of all other frames on air there.
///
///   signal         |-- preamble --|=========== payload ===========|
///   other frames          |----------------|    |---------|
///   chunks                        |   1    | 2  |    3    |   4   |
///
/// A preamble is found if it is stronger than noise and interference by `preamble_threshold` when
/// it has been on air for 4 us; of several at once the strongest is looked at first. A frame that
/// begins while the receiver is locked on another, or sends, is lost; so is the one that it is
/// locked on when it begins to send. Errors are those of the payload.
///
/// Frames weaker than the sensitivity by `interference_cut`, or than the noise floor by 10 dB, are
/// left out: each of them would change the interference by less than that (see
/// Network::interference_left_out).
///
/// Sources: the physical layer's error rates; IEEE 802.11-2020, clauses 15-18, for what a receiver
/// does; the threshold and the time of ns-3.37's ThresholdPreambleDetectionModel.
struct Sinr {
    static constexpr std::string_view name = "sinr";

    /// Cut of interference [dB], >= 0.
    Db interference_cut{20};
    /// Least ratio of signal to interference and noise [dB] at which a preamble is found.
    Db preamble_threshold{4};

    /// Judge for one Network.
    std::unique_ptr<Judge> make_judge() const;
};

/// Facts of a frame that judging it takes, beside what is on air.
struct SinrFrame {
    /// Physical layer, and coding and rate [bit/s] of the payload in it.
    const Phy* phy;
    Coding coding;
    double rate;
    /// Time on air of its payload [ns], which is its end.
    Duration payload;
    /// Noise floor of the receiver [dBm].
    Dbm noise = {};
};

/// Receivers of the model "sinr": judges frames, one at a time. It keeps no state of nodes, only
/// memory; SinrJudge tells it what is on air.
///
/// A judgement has three steps: which frames did the receiver lock on to up to this one; does the
/// node send meanwhile; and are all bits right, with the interference as it changes.
class SinrReceiver {
  public:
    explicit SinrReceiver(const Sinr& settings = {}) : settings_(settings) {}

    /// Decides the fate of `signal`, whose receiver can decode it, when it has ended: waiting if
    /// the frame is decoded. Locks of frames that began by then are decided, and kept with them.
    ///
    /// @param arrivals  frames on air at the receiver, `signal` itself among them, that ended after
    /// one that `signal` overlaps can have begun
    /// @param level_of  level_of(arrival) [dBm], asked once for each where it matters
    /// @param draw      uniform in (0, 1); asked if the outcome is not certain
    /// @param before    before(a, b) of two senders: whose frame is looked at first, if nothing
    /// else tells the two apart
    template <class LevelOf, class Draw, class Before = std::less<NodeId>>
    Fate judge(Arrival& signal, std::span<Arrival> arrivals, const SinrFrame& frame,
               LevelOf level_of, Draw draw, Before before = {}) {
        here_.clear();
        for (Arrival& a : arrivals) here_.push_back(&a);
        const auto level = [&](Arrival& a) {
            if (std::isnan(a.level_dbm)) a.level_dbm = level_of(a);
            return a.level_dbm;
        };
        if (*signal.lock == Lock::open) {
            sort_here(level, before);
            settle_locks(signal.begin, frame.noise, level);
        }
        if (sends_during(signal)) return Fate::busy;
        std::erase_if(here_,
                      [&](const Arrival* a) { return !a->overlaps(signal) || a == &signal; });
        const Fate lost = here_.empty() ? Fate::garbled : Fate::collided;
        if (*signal.lock == Lock::missed) return lost;
        level(signal);
        for (Arrival* a : here_) level(*a);
        sort_here(level, before);
        if (is_certain(signal, frame)) return Fate::waiting;
        if (draw() < math::exp(log_success_of(signal, frame))) return Fate::waiting;
        return lost;
    }

  private:
    // Sorts here_ by begin, and of frames that begin together the strongest first: what is decided
    // and summed does not depend on the order of becoming known.
    template <class Level, class Before>
    void sort_here(Level level, Before before) {
        std::sort(here_.begin(), here_.end(), [&](Arrival* a, Arrival* b) {
            if (a->begin != b->begin) return a->begin < b->begin;
            return level(*a) != level(*b) ? level(*a) > level(*b) : before(a->from, b->from);
        });
    }
    // Whether the node sends while the frame arrives.
    bool sends_during(const Arrival& judged) const;
    // Decides for all frames that began by `until`, in their order, whether the receiver locked on
    // to them.
    template <class Level>
    void settle_locks(Time until, Dbm noise, Level level) {
        for (Arrival* a : here_) {
            if (a->begin > until) return;
            if (!a->lock || *a->lock != Lock::open) continue;
            const bool locks = is_free_for(*a) && finds_preamble(*a, noise, level);
            *a->lock = locks ? Lock::held : Lock::missed;
        }
    }
    // Whether the preamble is strong enough among what is on air when it has been looked at for 4
    // us.
    template <class Level>
    bool finds_preamble(Arrival& preamble, Dbm noise, Level level) {
        constexpr Duration detection{4'000};
        const Time t = std::min(preamble.begin + detection, preamble.end - Duration{1});
        double others_mw = 0;
        for (Arrival* a : here_) {
            const bool on_air = a->begin <= t && t < a->end && a != &preamble;
            if (on_air) others_mw += math::exp10(level(*a) / 10);
        }
        if (others_mw == 0) return Dbm{level(preamble)} - noise >= settings_.preamble_threshold;
        const double interference_db = 10 * math::log10(others_mw + math::exp10(noise.value / 10));
        return Dbm{level(preamble)} - Dbm{interference_db} >= settings_.preamble_threshold;
    }
    // Whether the receiver was on no other frame when this one began.
    bool is_free_for(const Arrival& arrival) const;
    // Whether the node begins to send after `after`, not later than `until`.
    bool sends_within(Time after, Time until) const;
    // Whether the frame is decoded whatever is drawn: it is alone, and far above the noise.
    bool is_certain(const Arrival& judged, const SinrFrame& frame) const {
        return here_.empty() &&
               Dbm{judged.level_dbm} - frame.noise >= frame.phy->certain_sinr(frame.coding);
    }
    // Logarithm of the probability that all bits of the payload are right.
    double log_success_of(const Arrival& judged, const SinrFrame& frame);

    Sinr settings_;
    // Frames that are or were on air at the node, in the order of their begin; and memory for the
    // sums.
    std::vector<Arrival*> here_;
    // Times at which the interference changes within a payload.
    std::vector<Time> changes_;
    // Power of each frame of here_ [mW].
    std::vector<double> power_mw_;
};

}  // namespace rovernet
