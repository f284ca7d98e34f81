// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/link_gain.hpp"
#include "models/medium/link_losses.hpp"
#include "models/medium/medium_settings.hpp"
#include "models/medium/stations.hpp"
#include "sim/geometry.hpp"
#include "sim/ids.hpp"
#include "sim/random.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>

namespace rovernet {

/// Computation of arrivals: a transmitted frame as it reaches one receiver (times and level).
/// Judges of reception models use arrivals, see Interference::arrival(). The link is evaluated by
/// the cheapest method for the sender, see Decision. A level that depends only on the distance and
/// the pair of nodes is computed when level() or is_stronger() needs it.
class Arrivals {
  public:
    /// @param settings, stations, links  parts of the medium; must outlive this
    Arrivals(const MediumSettings& settings, Stations& stations, const LinkLosses& links);

    /// Propagation delay [ns] over a distance [m], >= 0.
    Duration delay(double distance) const {
        if (!settings_.propagation_delay) return Duration{0};
        const double nearest_ns = distance * (1e9 / speed_of_light) + 0.5;
        return Duration{static_cast<std::int64_t>(nearest_ns)};
    }
    /// Squared distance [m^2] beyond which `node` interferes at no other node; may be infinite.
    double squared_reach(NodeId node) {
        return stations_.kinds().squared_reach(stations_.kind(node), Strength::interfering);
    }
    /// Arrival of a frame at `to`, whose position is `at` [m] when the frame begins; empty if the
    /// signal is too weak to interfere, or if the nodes may not have a link.
    std::optional<Arrival> of(const Emission& frame, NodeId to, Vec3 at) {
        at.z += stations_.height(to);
        const double d2 = squared_distance(frame.origin, at);
        return d2 > frame.squared_reach ? std::nullopt : within_reach(frame, d2, to, at);
    }
    /// Arrival of a frame at `to`, as by of() without headings; needed if any antenna is
    /// directional.
    /// @param headings  headings of both ends when the frame begins
    std::optional<Arrival> of(const Emission& frame, NodeId to, Vec3 at, const Headings& headings);
    /// Received power [dBm] at `to` of a frame whose level was not computed.
    Dbm level(const Arrival& arrival, NodeId to) const;
    /// Whether the level of `frame` at `to` exceeds that of `other` by `by` or more. Levels are
    /// computed only if bounds on them do not decide.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId to);

  private:
    // Arrival of a frame within its reach, for of().
    std::optional<Arrival> within_reach(const Emission& frame, double d2, NodeId to, Vec3 there);
    // Arrival of a frame between nodes that may have a link, by Decision::by_loss.
    std::optional<Arrival> by_loss(const Emission& frame, double d2, NodeId to, Vec3 there,
                                   const Headings& headings);
    // Kind of the frame's sender while it transmits the frame's coding.
    Stations::Kind sender_kind(const Emission& frame) const {
        return stations_.kind(frame.from, frame.coding);
    }
    // Arrival of a frame over a squared distance, with this level.
    Arrival at_level(const Emission& frame, double d2, double level_dbm) const;

    const MediumSettings& settings_;
    Stations& stations_;
    const LinkLosses& links_;
    // Random draws of pairs, for Decision::by_table.
    PairDraws draws_;
};

}  // namespace rovernet
