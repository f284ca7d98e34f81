// SPDX-License-Identifier: MIT
#include "models/medium/link_losses.hpp"

#include <algorithm>
#include <limits>

namespace rovernet {

LinkBatch LinkLosses::batch(NodeId from, Vec3 origin, Time t, std::uint64_t frame) const {
    return {.frequency = stations_.radio(from).frequency,
            .from = origin,
            .to = {},
            .from_key = stations_.key(from),
            .scene = &settings_.scene_at(t),
            .floor_height = settings_.floor_height,
            .seed = settings_.seed,
            .replication = settings_.replication,
            .at = t,
            .frame = frame};
}

bool LinkLosses::is_up(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return from != to && stations_.is_on(from) && stations_.is_on(to) &&
           stations_.may_link(from, to) && margin(from, to, t, legs) >= Db{0};
}

Dbm LinkLosses::level(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return received_power(stations_.radio(from), path_loss(from, to, t, legs),
                          stations_.gain(from, to, t, legs));
}

Db LinkLosses::margin(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return stations_.kinds().budget(Strength::decodable, stations_.kind(from), stations_.kind(to),
                                    stations_.gain(from, to, t, legs)) -
           path_loss(from, to, t, legs);
}

LossShape LinkLosses::shape(NodeId from, NodeId to, Time t, const Legs& legs) const {
    const Leg a = legs.leg(from), b = legs.leg(to);
    const bool by_heading =
        stations_.radio(from).is_directional() || stations_.radio(to).is_directional();
    if (by_heading && may_change(from, to, t, legs)) return LossShape::unknown;
    const auto velocity = [t](const Leg& leg) { return t < leg.end ? leg.velocity : Vec3{}; };
    return shape_in_motion(stations_.model(from).shape(), velocity(a), velocity(b));
}

bool LinkLosses::may_change(NodeId from, NodeId to, Time t, const Legs& legs) const {
    const bool by_heading =
        stations_.radio(from).is_directional() || stations_.radio(to).is_directional();
    const auto goes_on = [&](const Leg& leg) {
        return t < leg.end && (leg.velocity != Vec3{} || (by_heading && leg.turning != 0));
    };
    return goes_on(legs.leg(from)) || goes_on(legs.leg(to));
}

Db LinkLosses::path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return {of_frame(from, to, stations_.antenna(from, t, legs), stations_.antenna(to, t, legs), t,
                     0, Db{std::numeric_limits<double>::infinity()})};
}

double LinkLosses::of_frame(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t,
                            std::uint64_t frame, Db cutoff) const {
    const Db most = cutoff + most_fade();
    const auto known = recent_.find({from, to, here, there, &settings_.scene_at(t)}, most);
    return faded(known ? *known : mean(from, to, here, there, t, frame, most), from, to, here,
                 there, frame);
}

double LinkLosses::mean(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                        Db cutoff) const {
    const std::uint64_t key = stations_.key(to);
    LinkBatch link = batch(from, here, t, frame);
    link.to = {&there, 1};
    link.to_keys = {&key, 1};
    double db = 0;
    stations_.model(from).loss(link, cutoff, {&db, 1});
    return db;
}

/// Path loss of a frame [dB]; equal to the local mean if there is no frame.
double LinkLosses::faded(double loss_db, NodeId from, NodeId to, Vec3 here, Vec3 there,
                         std::uint64_t frame) const {
    if (!fades_ || frame == 0) return loss_db;
    const Db gain = fades_->gain({.key = frame,
                                  .receiver = stations_.key(to),
                                  .from = here,
                                  .to = there,
                                  .frequency = stations_.radio(from).frequency});
    return std::max(0.0, loss_db - gain.value);
}

}  // namespace rovernet
