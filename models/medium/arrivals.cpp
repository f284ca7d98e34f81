// SPDX-License-Identifier: MIT
#include "models/medium/arrivals.hpp"

#include "models/propagation/shadowed_range.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace rovernet {

Arrivals::Arrivals(const MediumSettings& settings, Stations& stations, const LinkLosses& links)
    : settings_(settings),
      stations_(stations),
      links_(links),
      draws_(shadowing_draws(settings.seed, settings.replication)) {}

Arrival Arrivals::at_level(const Emission& frame, double d2, double level_dbm) const {
    const Duration under_way = delay(std::sqrt(d2));
    return {.begin = frame.begin + under_way,
            .end = frame.end + under_way,
            .level_dbm = level_dbm,
            .squared_distance = d2,
            .from = frame.from,
            .coding = frame.coding};
}

std::optional<Arrival> Arrivals::of(const Emission& frame, NodeId to, Vec3 at,
                                    const Headings& headings) {
    at.z += stations_.height(to);
    const double d2 = squared_distance(frame.origin, at);
    if (d2 > frame.squared_reach || !stations_.may_link(frame.from, to)) return std::nullopt;
    return by_loss(frame, d2, to, at, headings);
}

std::optional<Arrival> Arrivals::by_loss(const Emission& frame, double d2, NodeId to, Vec3 there,
                                         const Headings& headings) {
    RadioKinds& kinds = stations_.kinds();
    const Radio &sender = kinds.radio(stations_.kind(frame.from)),
                &receiver = kinds.radio(stations_.kind(to));
    const LinkGain gain = LinkGain::of(sender, receiver, [&] {
        return std::pair{Pose{frame.origin, headings.from}, Pose{there, headings.to}};
    });
    const Db most =
        kinds.budget(Strength::interfering, sender_kind(frame), stations_.kind(to), gain);
    const std::uint64_t key = links_.frame_key(frame.from, frame.begin);
    const Db lost{links_.of_frame(frame.from, to, frame.origin, there, frame.begin, key, most)};
    if (lost > most) return std::nullopt;
    return at_level(frame, d2, received_power(sender, lost, gain).value);
}

std::optional<Arrival> Arrivals::within_reach(const Emission& frame, double d2, NodeId to,
                                              Vec3 there) {
    RadioKinds& kinds = stations_.kinds();
    const Stations::Kind mine = sender_kind(frame), theirs = stations_.kind(to);
    if (!kinds.may_link(mine, theirs)) return std::nullopt;
    kinds.prepare(mine);
    if (kinds.decision(mine) != Decision::by_range) return of_pair(frame, d2, to, there);
    if (d2 > kinds.squared_range(mine, theirs, Strength::interfering)) return std::nullopt;
    return at_level(frame, d2, std::numeric_limits<double>::quiet_NaN());
}

std::optional<Arrival> Arrivals::of_pair(const Emission& frame, double d2, NodeId to, Vec3 there) {
    RadioKinds& kinds = stations_.kinds();
    const Stations::Kind mine = sender_kind(frame), theirs = stations_.kind(to);
    if (kinds.decision(mine) == Decision::by_loss) return by_loss(frame, d2, to, there, {});
    const auto& table = kinds.table(mine, theirs, Strength::interfering);
    if (!table.in_range(d2, draws_.bits(stations_.key(frame.from), stations_.key(to))))
        return std::nullopt;
    return at_level(frame, d2, std::numeric_limits<double>::quiet_NaN());
}

Dbm Arrivals::level(const Arrival& arrival, NodeId to) const {
    // Distance and pair determine the level, which is the same for all frames of the link.
    const RadioKinds& kinds = stations_.kinds();
    const double z = kinds.antennas().first.value;
    const Vec3 there{std::sqrt(arrival.squared_distance), 0, z};
    const Db lost{links_.mean(arrival.from, to, {0, 0, z}, there, arrival.begin, 0,
                              Db{std::numeric_limits<double>::infinity()})};
    return received_power(kinds.radio(stations_.kind(arrival.from)),
                          kinds.radio(stations_.kind(to)), lost);
}

bool Arrivals::is_stronger(Arrival& frame, Arrival& other, Db by, NodeId to) {
    RadioKinds& kinds = stations_.kinds();
    const Stations::Kind sender = stations_.kind(frame.from);
    const bool open = std::isnan(frame.level_dbm) && std::isnan(other.level_dbm);
    if (open && stations_.kind(other.from) == sender &&
        kinds.decision(sender) == Decision::by_range) {
        const auto mine = kinds.loss_bounds(sender, frame.squared_distance);
        const auto theirs = kinds.loss_bounds(sender, other.squared_distance);
        if (theirs.low >= mine.high + by.value) return true;
        if (theirs.high < mine.low + by.value) return false;
    }
    for (Arrival* each : {&frame, &other}) {
        if (std::isnan(each->level_dbm)) each->level_dbm = level(*each, to).value;
    }
    return frame.level_dbm >= other.level_dbm + by.value;
}

}  // namespace rovernet
