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

/// Frames as they arrive at single nodes: what the judges of receptions look at. Each is decided in
/// the way that is cheapest for its sender, see Decision; levels that the distance and the pair
/// decide stay open until somebody asks for them.
class Arrivals {
  public:
    /// @param settings, stations, links  of the medium; outlive this
    Arrivals(const MediumSettings& settings, Stations& stations, const LinkLosses& links);

    /// Time [ns] that a frame takes over a distance [m], >= 0.
    Duration delay(double distance) const {
        if (!settings_.propagation_delay) return Duration{0};
        const double nearest_ns = distance * (1e9 / speed_of_light) + 0.5;
        return Duration{static_cast<std::int64_t>(nearest_ns)};
    }
    /// Squared distance [m^2] beyond which `node` interferes with nobody; may be infinite.
    double squared_reach(NodeId node) {
        return stations_.kinds().squared_reach(stations_.kind(node), Strength::interfering);
    }
    /// Frame as it arrives at `to`, which is `at` [m] when it begins; nothing if it is too weak to
    /// interfere, or if the two may have no link.
    std::optional<Arrival> of(const Emission& frame, NodeId to, Vec3 at) {
        at.z += stations_.height(to);
        const double d2 = squared_distance(frame.origin, at);
        return d2 > frame.squared_reach ? std::nullopt : within_reach(frame, d2, to, at);
    }
    /// Frame as it arrives at `to`, as above, where some antenna is directional.
    /// @param headings  of both ends when the frame begins
    std::optional<Arrival> of(const Emission& frame, NodeId to, Vec3 at, const Headings& headings);
    /// Received power [dBm] at `to` of a frame whose level was left open.
    Dbm level(const Arrival& arrival, NodeId to) const;
    /// Whether the level of `frame` at `to` exceeds that of `other` by `by` or more. Levels that
    /// are open remain so if that is plain without them.
    bool is_stronger(Arrival& frame, Arrival& other, Db by, NodeId to);

  private:
    // Frame as of() has it, within its reach.
    std::optional<Arrival> within_reach(const Emission& frame, double d2, NodeId to, Vec3 there);
    // Frame as it arrives between two that may have a link, by Decision::by_loss.
    std::optional<Arrival> by_loss(const Emission& frame, double d2, NodeId to, Vec3 there,
                                   const Headings& headings) const;
    // Frame that arrives over a squared distance, with this level.
    Arrival at_level(const Emission& frame, double d2, double level_dbm) const;

    const MediumSettings& settings_;
    Stations& stations_;
    const LinkLosses& links_;
    // Draws of links, where tables decide.
    PairDraws draws_;
};

}  // namespace rovernet
