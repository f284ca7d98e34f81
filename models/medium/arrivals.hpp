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

/// Computation of arrivals: times and level of a transmitted frame at one receiver. Judges of
/// reception models use arrivals, see Interference::arrival(). The link is evaluated by the fastest
/// method that the sender's model allows, see Decision. A level that depends only on the distance
/// and the pair of nodes is computed when level() or is_stronger() needs it.
class Arrivals {
  public:
    /// @param settings, stations, links  parts of the medium; must outlive the Arrivals
    Arrivals(const MediumSettings& settings, Stations& stations, const LinkLosses& links);

    /// Propagation delay [ns] over a distance [m] >= 0; 0 if delays are switched off.
    Duration delay(double distance) const {
        if (!settings_.propagation_delay) return Duration{0};
        const double nearest_ns = distance * (1e9 / speed_of_light) + 0.5;
        return Duration{static_cast<std::int64_t>(nearest_ns)};
    }
    /// Square of the largest distance [m^2] at which `node` interferes; may be infinite.
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
    /// Arrival of a frame at `to`, as by of() without headings, but with directional antennas.
    /// @param headings  headings of sender and receiver when the frame begins
    std::optional<Arrival> of(const Emission& frame, NodeId to, Vec3 at, const Headings& headings);
    /// Computes the received power [dBm] at `to` for an Arrival without a level (NaN).
    Dbm level(const Arrival& arrival, NodeId to) const;
    /// Whether the level of `frame` at `to` exceeds the level of `other` by `by` [dB] or more.
    /// Levels are computed only if bounds on them do not decide.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId to);

  private:
    // Arrival of a frame at `to`, a node within the frame's reach at squared distance d2 [m^2].
    std::optional<Arrival> within_reach(const Emission& frame, double d2, NodeId to, Vec3 there);
    // Arrival of such a frame if the sender's model decides by the pair of nodes, not by the
    // distance alone: by the pair's shadowing draw, or by the loss.
    std::optional<Arrival> of_pair(const Emission& frame, double d2, NodeId to, Vec3 there);
    // Arrival of a frame at `to`, with the path loss by the model; the gates must allow the link.
    std::optional<Arrival> by_loss(const Emission& frame, double d2, NodeId to, Vec3 there,
                                   const Headings& headings);
    // Kind of station of the frame's sender, for the frame's coding (see RadioKinds).
    Stations::Kind sender_kind(const Emission& frame) const {
        return stations_.kind(frame.from, frame.coding);
    }
    // Arrival of a frame at the squared distance d2 [m^2] with the received power level_dbm.
    Arrival at_level(const Emission& frame, double d2, double level_dbm) const;

    const MediumSettings& settings_;
    Stations& stations_;
    const LinkLosses& links_;
    // Shadowing draws of pairs of nodes, for Decision::by_table.
    PairDraws draws_;
};

}  // namespace rovernet
