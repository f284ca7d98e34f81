// SPDX-License-Identifier: MIT
#include "models/medium/medium.hpp"

#include "models/medium/shadowed.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

std::shared_ptr<const Fades> fades_of(const MediumSettings& settings) {
    if (settings.fading.model == FadingModel::none) return nullptr;
    return std::make_shared<Fades>(settings.fading, settings.seed, settings.replication);
}

}  // namespace

Medium::Medium(const Settings& settings)
    : settings_(settings),
      draws_(shadowing_draws(settings.seed, settings.replication)),
      fades_(fades_of(settings)),
      kinds_(settings.interference_cut, fades_ ? std::optional<Db>(fades_->most()) : std::nullopt) {
    check_fields(settings.shadowing, "shadowing");
}

Propagation Medium::shadowed(const Propagation& model) {
    if (settings_.shadowing.model == ShadowingModel::none || model.as<Shadowed>()) return model;
    for (const auto& [plain, with_shadowing] : shadowed_) {
        if (plain == model) return with_shadowing;
    }
    const Propagation with_shadowing =
        Shadowed(model, settings_.shadowing, settings_.seed, settings_.replication);
    shadowed_.emplace_back(model, with_shadowing);
    return with_shadowing;
}

void Medium::add(const Radio& radio, std::uint64_t key, const Propagation& propagation) {
    check_fields(radio, "radio");
    check_antenna(radio);
    propagation.check_frequency(radio.frequency);
    if (radios_.empty() || radios_.back() != radio) radios_.push_back(radio);
    const Kind kind = kinds_.add(radio, shadowed(propagation));
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

LossShape Medium::shape(NodeId from, NodeId to, Time t, const Legs& legs) const {
    const Leg a = legs.leg(from), b = legs.leg(to);
    const bool by_heading = radio(from).is_directional() || radio(to).is_directional();
    if (by_heading && may_change(from, to, t, legs)) return LossShape::unknown;
    const auto velocity = [t](const Leg& leg) { return t < leg.end ? leg.velocity : Vec3{}; };
    return shape_in_motion(model(from).shape(), velocity(a), velocity(b));
}

bool Medium::may_change(NodeId from, NodeId to, Time t, const Legs& legs) const {
    const bool by_heading = radio(from).is_directional() || radio(to).is_directional();
    const auto goes_on = [&](const Leg& leg) {
        return t < leg.end && (leg.velocity != Vec3{} || (by_heading && leg.turning != 0));
    };
    return goes_on(legs.leg(from)) || goes_on(legs.leg(to));
}

Db Medium::path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return {loss(from, to, antenna(from, t, legs), antenna(to, t, legs), t, 0,
                 Db{std::numeric_limits<double>::infinity()})};
}

/// Path loss [dB] from `from` here to `to` there; a frame sees it faded.
double Medium::loss(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t, std::uint64_t frame,
                    Db give_up) const {
    const Db most = fades_ ? give_up + fades_->most() : give_up;
    const auto known = recent_.find({from, to, here, there}, most);
    const double mean = known ? *known : computed_loss(from, to, here, there, t, frame, most);
    return faded(mean, from, to, here, there, frame);
}

/// Path loss [dB] by the model, the local mean.
double Medium::computed_loss(NodeId from, NodeId to, Vec3 here, Vec3 there, Time t,
                             std::uint64_t frame, Db give_up) const {
    LinkBatch link = batch(from, here, t, frame);
    link.to = {&there, 1};
    link.to_keys = {&keys_[to.index()], 1};
    double db = 0;
    model(from).loss(link, give_up, {&db, 1});
    return db;
}

/// Loss [dB] that a frame sees; the local mean has no frame.
double Medium::faded(double loss_db, NodeId from, NodeId to, Vec3 here, Vec3 there,
                     std::uint64_t frame) const {
    if (!fades_ || frame == 0) return loss_db;
    const Db gain = fades_->gain({.key = frame,
                                  .receiver = key(to),
                                  .from = here,
                                  .to = there,
                                  .frequency = radio(from).frequency});
    return std::max(0.0, loss_db - gain.value);
}

}  // namespace rovernet
