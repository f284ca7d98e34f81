// SPDX-License-Identifier: MIT
#pragma once

#include "models/medium.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <optional>

namespace rovernet {

/// When something moving straight is within a range.
struct Passage {
    double enter;  ///< [s]
    double leave;  ///< [s], > enter
};

/// When |r + v t| < R, for relative position r [m] and velocity v [m/s]; none if never, always, or
/// if it only touches. The times are roots of a quadratic, found without cancellation.
std::optional<Passage> range_crossing(Vec3 r, Vec3 v, double R);

/// [links] of a scenario.
struct LinkSearch {
    Duration tolerance{1'000'000};  ///< [ns] a change behind walls is known to this, >= 1 ns
    Duration min_dwell{
        100'000'000};  ///< [ns] of models of unknown shape: shorter states are missed
};

/// The first time in (after, until] at which the link from `from` to `to` is not what it is at
/// `after`, on the legs as they are now; none if there is no such time. Neither leg may end before
/// `until` other than by coming to rest.
///
/// For models by distance it is exact to the nanosecond, behind walls within the tolerance.
std::optional<Time> next_link_change(const Medium& medium, const Legs& legs, const Scene& scene,
                                     NodeId from, NodeId to, Time after, Time until,
                                     const LinkSearch& search);

}  // namespace rovernet
