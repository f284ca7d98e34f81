// SPDX-License-Identifier: MIT
#pragma once

#include "models/links/link_search.hpp"
#include "models/links/wall_passages.hpp"
#include "sim/ids.hpp"
#include "sim/legs.hpp"
#include "sim/time.hpp"

#include <cstdint>
#include <optional>

// Prediction of link changes: as roots of equations if the loss depends on distance, by a guided
// search otherwise. The network's LinkWatch predicts changes for each pair of robots after a new
// leg.
//
//     const auto change = next_link_change(medium, legs, scene, a, b, now, legs.leg(a).end, {});
//     if (change) ...  // at *change the link is up if it was down, and the reverse

namespace rovernet {

class Medium;
class Scene;

/// First time in (after, until] at which the link from `from` to `to` goes up or down, while both
/// nodes stay on their current legs; empty if there is no such time. A leg may end before `until`
/// only by coming to rest. The radios must not be switched or change their network in this time.
///
/// The state of a link is LinkLosses::is_up at whole nanoseconds; at the returned time the link has
/// its new state. A pair that is out of range even without walls (Propagation::reach) is not
/// sampled. The search depends on the LossShape:
/// - by distance: exact to the nanosecond; a state shorter than a nanosecond may be missed. At most
///   about 45 samples of the link, often 8; none for a pair that stays out of range.
/// - by walls: a jump of the loss is found about a nanosecond late (WallPassages return the times
///   to sample), other changes up to `tolerance` late. With k passed corners there are about 4 k
///   samples, and more where the loss comes near the budget. There an interval between passages is
///   sampled at both ends and in the middle, and halved until the loss surely does not cross the
///   budget in between: a parabola through the samples could add at most 1/16 of their distance to
///   the budget.
/// - unknown: a sample every `min_dwell`; a change between two samples is located as for walls. The
///   step doubles every 65536 samples, so that every search ends.
///
/// @param walls  walls of the medium's scene; may be empty unless the sender's model depends on
///               walls
/// @throws std::invalid_argument if a duration of `search` is < 1 ns
std::optional<Time> next_link_change(const Medium& medium, const Legs& legs,
                                     const WallPassages& walls, NodeId from, NodeId to, Time after,
                                     Time until, const LinkSearch& search);

/// Result of a search for a link change: time of the change, or time up to which the link does not
/// change.
struct LinkOutlook {
    /// Time of the next change; empty if none was found up to `until`.
    std::optional<Time> change;
    /// End of the time span that was searched.
    Time until;
};

/// Search like next_link_change(), limited to `most_looks` samples for a propagation model of
/// unknown shape. A search that is continued from LinkOutlook::until samples the same times as a
/// single search.
/// @param most_looks  largest number of samples, >= 1
LinkOutlook look_ahead(const Medium& medium, const Legs& legs, const WallPassages& walls,
                       NodeId from, NodeId to, Time after, Time until, const LinkSearch& search,
                       std::int64_t most_looks);

/// Time of the first link change, see next_link_change() with WallPassages. This overload makes the
/// WallPassages of `scene` itself if the model needs it. For many searches, pass one WallPassages
/// instead.
std::optional<Time> next_link_change(const Medium& medium, const Legs& legs, const Scene& scene,
                                     NodeId from, NodeId to, Time after, Time until,
                                     const LinkSearch& search);

}  // namespace rovernet
