// SPDX-License-Identifier: MIT
#include "models/medium/medium.hpp"

#include "sim/math.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rovernet {
void Medium::add(const Radio& radio, std::uint64_t key, const Propagation& propagation) {
    check_fields(radio, "radio");
    propagation.check_frequency(radio.frequency);
    if (radios_.empty() || radios_.back() != radio) radios_.push_back(radio);
    const Kind kind = kinds_.add(radio, propagation);
    keys_.push_back(key);
    if (radios_.size() > 1 || kinds_.size() > 1 || !stations_.empty()) {
        list_stations();
        stations_.back().radio = static_cast<std::uint32_t>(radios_.size() - 1);
        stations_.back().kind = kind & 0x7fffffff;
    }
    index_.add(kind);
    ++changes_;
    cells_chosen_ = false;
}

/// Lists the stations that are not listed yet: they are as the first one, and on.
void Medium::list_stations() {
    stations_.reserve(keys_.capacity());
    stations_.resize(keys_.size(), {.radio = 0, .kind = 0, .on = true});
}

void Medium::switch_radio(NodeId node, bool on) {
    list_stations();
    Station& station = stations_[node.index()];
    off_ += static_cast<std::size_t>(station.on) - static_cast<std::size_t>(on);
    station.on = on;
    ++changes_;
}

Vec3 Medium::antenna(NodeId node, Time t, const Legs& legs) const {
    Vec3 p = legs.position(node, t);
    p.z += kinds_.height(kind(node));
    return p;
}

Pose Medium::pose(NodeId node, Time t, const Legs& legs) const {
    return {antenna(node, t, legs), Radians{legs.leg(node).heading_at(t)}};
}

LinkBatch Medium::batch(NodeId from, Vec3 origin, Time t, std::uint64_t frame) const {
    return {.frequency = radio(from).frequency,
            .from = origin,
            .to = {},
            .from_key = key(from),
            .to_keys = {},
            .scene = settings_.scene,
            .floor_height = settings_.floor_height,
            .seed = settings_.seed,
            .replication = settings_.replication,
            .at = t,
            .frame = frame};
}

Db Medium::left_out(std::size_t frames) const {
    assert(settings_.interference_cut);
    Db most{0};
    for (Kind each = 0; each < kinds_.size(); ++each) {
        const Db above_noise = kinds_.weakest_interfering(kinds_.radio(each)) - kinds_.noise(each);
        const double sum = 1 + static_cast<double>(frames) * math::exp10(above_noise.value / 10);
        most = std::max(most, Db{10 * math::log10(sum)});
    }
    return most;
}

bool Medium::link_up(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return from != to && is_on(from) && is_on(to) && may_link(from, to) &&
           margin(from, to, t, legs) >= Db{0};
}

Dbm Medium::level(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return received_power(radio(from), path_loss(from, to, t, legs), gain(from, to, t, legs));
}

Db Medium::margin(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return link_budget(radio(from), radio(to), gain(from, to, t, legs)) -
           path_loss(from, to, t, legs);
}

Db Medium::path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return {loss(from, to, antenna(from, t, legs), antenna(to, t, legs), t, 0,
                 Db{std::numeric_limits<double>::infinity()})};
}

/// Path loss [dB] from `from` here to `to` there.
double Medium::loss(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                    Db give_up) const {
    LinkBatch link = batch(from, here, t, frame);
    link.to = {&there, 1};
    link.to_keys = {&keys_[to.index()], 1};
    double db = 0;
    model(from).loss(link, give_up, {&db, 1});
    return db;
}

}  // namespace rovernet
