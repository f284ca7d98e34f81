// SPDX-License-Identifier: MIT
#pragma once

#include "models/on_air.hpp"
#include "sim/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace rovernet {

/// Which frame can capture a receiver where two overlap.
enum class CaptureOrder {
    first,  ///< the one that began first, as in ns-2
    later,  ///< either
};
template <>
struct EnumNames<CaptureOrder> {
    static constexpr std::array<std::string_view, 2> values = {"first", "later"};
};

/// Reception rung "collision": frames that overlap at a node destroy each other, unless one
/// captures it; and a node that sends hears nothing.
///
/// Of two frames f and g that overlap at a node, f survives g iff it is stronger by the capture
/// ratio and begins no later than g (or `order` lets a later one capture). The rule holds for each
/// pair, so that what becomes of a frame does not depend on the order in which arrivals are made
/// known, and they can be made known when they are sent.
/// Source: ns-2.35's 802.11, whose receiver compares a frame with the one that it is at, only.
struct Collision {
    Db capture_ratio{10};  ///< [dB] > 0
    CaptureOrder capture = CaptureOrder::first;

    /// Makes a frame known that will arrive at `node` after `now`. Calls lost(arrival) for each
    /// frame that this costs, itself included, perhaps again: arrival.collided says whether by
    /// another frame, else the node itself sends. level_of(arrival) [dBm] is asked where it
    /// matters.
    template <class LevelOf, class Lost>
    void add(OnAir& on_air, NodeId node, Arrival arrival, Time now, LevelOf level_of,
             Lost lost) const {
        const auto level = [&](Arrival& a) {
            if (std::isnan(a.level_dbm)) a.level_dbm = level_of(a);
            return a.level_dbm;
        };
        const auto survives = [&](Arrival& f, Arrival& g) {
            return (f.begin <= g.begin || capture == CaptureOrder::later) &&
                   level(f) >= level(g) + capture_ratio.value;
        };
        const auto meet = [&](Arrival& f, Arrival& g) {
            if (f.collided || f.reception == Arrival::no_reception || survives(f, g)) return;
            f.collided = g.from != node;
            lost(f);
        };
        Cover cover;
        on_air.each(node, now, [&](Arrival& other) {
            if (arrival.overlaps(other)) {
                meet(arrival, other);
                meet(other, arrival);
            }
            return other.from == node || !cover.covers(other, now, level);
        });
        on_air.add(node, arrival, now);
    }

  private:
    /// In a crowd, the strongest of the frames on air that nobody receives any more. Whatever a
    /// weaker one that begins no sooner and ends no later can still do to others, it does as well,
    /// so that lists stay short.
    struct Cover {
        static constexpr int crowd = 8;  // few are left as they are, and no levels computed
        int seen = 0;
        Time begin = never, end = Time::min();
        double level_dbm = -std::numeric_limits<double>::infinity();

        template <class Level>
        bool covers(Arrival& a, Time now, Level level) {
            const bool spent = a.collided || a.reception == Arrival::no_reception;
            if (++seen <= crowd || !spent) return false;
            // What is to come begins later than all that began before now, whichever did first.
            const Time since = std::max(a.begin, now - Duration{1});
            if (since >= begin && a.end <= end && level(a) <= level_dbm) return true;
            if (level(a) > level_dbm) *this = {seen, since, a.end, a.level_dbm};
            return false;
        }
    };
};

}  // namespace rovernet
