// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_search.hpp"
#include "models/links/wall_passages.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <optional>

// Changes of links, found ahead of time: roots of equations where the loss goes by distance, a
// guided search where it does not. LinkWatch of the network asks for each pair after each new leg.
//
//     const auto change = next_link_change(medium, legs, scene, a, b, now, legs.leg(a).end, {});
//     if (change) ...  // at *change the link is up if it was down, and the reverse

namespace rovernet {

class Medium;
class Scene;

/// The first time in (after, until] at which the link from `from` to `to` is not what it is at
/// `after`, on the legs as they are now; none if there is no such time. Neither leg may end before
/// `until` other than by coming to rest. Who is on and may link does not change meanwhile.
///
/// The state is LinkLosses::is_up at whole nanoseconds, and it is the new one at the time returned.
/// Where the link would be down without any wall (Propagation::reach) nothing is looked at.
/// - By distance: exact to the nanosecond; a state of less than a nanosecond may be missed. About
///   45 looks at the link, often 8; none for a pair that stays out of reach.
/// - By walls: a jump of the loss comes a nanosecond or so late (WallPassages tell where to look),
///   other changes up to `tolerance`. With k corners passed about 4 k looks, more where the loss
///   bends near the budget: a time between passages is halved until its ends and its middle are
///   farther from the budget than 16 times what a parabola through them could add in between.
/// - Unknown: a look each `min_dwell`, then as by walls; from the 65536th look on the step doubles
///   every 65536 looks, so that no search is endless.
///
/// @param walls  of the medium's scene; may be empty if the sender's model is not by walls
/// @throws std::invalid_argument if a duration of `search` is < 1 ns
std::optional<Time> next_link_change(const Medium& medium, const Legs& legs,
                                     const WallPassages& walls, NodeId from, NodeId to, Time after,
                                     Time until, const LinkSearch& search);

/// As above; collects the walls' corners first, if it needs them. For many searches keep a
/// WallPassages.
std::optional<Time> next_link_change(const Medium& medium, const Legs& legs, const Scene& scene,
                                     NodeId from, NodeId to, Time after, Time until,
                                     const LinkSearch& search);

}  // namespace rovernet
