// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/phy/phy.hpp"
#include "models/reception/sinr.hpp"
#include "sim/math.hpp"
#include "sim/record.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

namespace rovernet {

/// Data of a frame that determine its fate, in addition to the frames on air.
struct SinrFrame {
    /// Physical layer of all frames. Below: coding and bit rate [bit/s] of the frame's payload.
    const Phy* phy;
    Coding coding;
    double rate;
    /// Airtime of the frame's payload [ns], the last part of the frame.
    Duration payload;
    /// Noise floor of the receiver [dBm].
    Dbm noise = {};
};

/// Receiver of the model "sinr": judges one frame at a time. A SinrReceiver has no state of nodes,
/// only memory for reuse; SinrJudge passes the frames on air to it.
///
/// A judgement determines three facts, in this order: onto which of the frames up to the judged one
/// the receiver locked; whether the node transmits during the judged frame; whether all bits of the
/// judged frame are right under the varying interference.
class SinrReceiver {
  public:
    explicit SinrReceiver(const Sinr& settings = {}) : settings_(settings) {}

    /// Determines the fate of the frame `signal` after its end; the frame must be strong enough to
    /// be decoded. Returns `waiting` if the frame is decoded. Also determines and stores whether
    /// the receiver locked onto frames that began before `signal`.
    ///
    /// @param arrivals  frames on air at the receiver, including `signal`, as far back as they can
    ///                  affect the lock of a frame that overlaps `signal`
    /// @param level_of  level_of(arrival) [dBm], called at most once for each arrival
    /// @param draw      uniform draw in (0, 1), called if the result is not certain
    /// @param before    before(a, b): order of two senders, for frames with equal start and level
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
            settle_locks(signal.begin, frame, level);
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
    // Sorts here_ by begin, then by falling level, so that decisions and sums do not depend on the
    // order of the input.
    template <class Level, class Before>
    void sort_here(Level level, Before before) {
        if (here_.size() < 2) return;  // the usual case: no other frame
        std::sort(here_.begin(), here_.end(), [&](Arrival* a, Arrival* b) {
            if (a->begin != b->begin) return a->begin < b->begin;
            return level(*a) != level(*b) ? level(*a) > level(*b) : before(a->from, b->from);
        });
    }
    // Whether the node of the receiver transmits during the frame `judged`.
    bool sends_during(const Arrival& judged) const;
    // Determines for all frames that began by `until`, in order, whether the receiver locked onto
    // them.
    template <class Level>
    void settle_locks(Time until, const SinrFrame& frame, Level level) {
        for (Arrival* a : here_) {
            if (a->begin > until) return;
            if (!a->lock || *a->lock != Lock::open) continue;
            const bool locks = is_free_for(*a) && finds_preamble(*a, frame, level);
            *a->lock = locks ? Lock::held : Lock::missed;
        }
    }
    // Whether the SINR of the preamble reaches the threshold at the time of detection.
    template <class Level>
    bool finds_preamble(Arrival& preamble, const SinrFrame& frame, Level level) {
        const PreambleDetection rule = frame.phy->preamble_detection(preamble.coding);
        const Db threshold = rule.threshold.value_or(settings_.preamble_threshold);
        const Time t = std::min(preamble.begin + rule.after, preamble.end - Duration{1});
        double others_mw = 0;
        for (Arrival* a : here_) {
            const bool on_air = a->begin <= t && t < a->end && a != &preamble;
            if (!on_air) continue;
            const double rejection = frame.phy->rejection(preamble.coding, a->coding);
            others_mw += rejection * math::exp10(level(*a) / 10);
        }
        if (others_mw == 0) return Dbm{level(preamble)} - frame.noise >= threshold;
        const double interference_db =
            10 * math::log10(others_mw + math::exp10(frame.noise.value / 10));
        return Dbm{level(preamble)} - Dbm{interference_db} >= threshold;
    }
    // Whether the receiver was free when `arrival` began: neither transmitting nor locked onto
    // another frame.
    bool is_free_for(const Arrival& arrival) const;
    // Whether the node of the receiver begins to transmit in (after, until].
    bool sends_within(Time after, Time until) const;
    // Whether the frame is decoded for any random draw: no other frame is on air, and the level of
    // the frame is far above the noise.
    bool is_certain(const Arrival& judged, const SinrFrame& frame) const {
        return here_.empty() &&
               Dbm{judged.level_dbm} - frame.noise >= frame.phy->certain_sinr(frame.coding);
    }
    // Natural logarithm of the probability that all bits of the payload are right.
    double log_success_of(const Arrival& judged, const SinrFrame& frame);

    Sinr settings_;
    // Frames that are or were on air at the node, in the order of their starts; kept to reuse the
    // memory.
    std::vector<Arrival*> here_;
    // Times at which the interference changes during the payload of the judged frame, with begin
    // and end of the payload.
    std::vector<Time> changes_;
    // Interference power of each frame of here_ [mW]: received power times the fraction
    // Phy::rejection() of the power that interferes.
    std::vector<double> power_mw_;
};

}  // namespace rovernet
