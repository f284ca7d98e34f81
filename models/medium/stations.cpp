// SPDX-License-Identifier: MIT
#include "models/medium/stations.hpp"

#include "models/medium/shadowed.hpp"

#include <algorithm>

namespace rovernet {

Stations::Stations(const MediumSettings& settings, std::optional<Db> most_fade)
    : shadowing_(settings.shadowing),
      seed_(settings.seed),
      replication_(settings.replication),
      kinds_(settings.phy, settings.interference_cut, most_fade) {
    check_fields(shadowing_, "shadowing");
}

Propagation Stations::shadowed(const Propagation& model) {
    const bool is_none = shadowing_.model == ShadowingModel::none || shadowing_.sigma.value == 0;
    if (is_none || model.as<Shadowed>()) return model;
    for (const auto& [plain, with_shadowing] : shadowed_) {
        if (plain == model) return with_shadowing;
    }
    const Propagation with_shadowing = Shadowed(model, shadowing_, seed_, replication_);
    shadowed_.emplace_back(model, with_shadowing);
    return with_shadowing;
}

Stations::Kind Stations::add(const Radio& radio, std::uint64_t key,
                             const Propagation& propagation) {
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
    return kind;
}

void Stations::list_stations() {
    stations_.reserve(keys_.capacity());
    stations_.resize(keys_.size(), {.radio = 0, .kind = 0, .on = true});
}

Stations::Kind Stations::kind_of_coding(NodeId node, Coding coding) {
    const Kind found = kinds_.of_coding(kind(node), coding);
    if (kinds_.size() > 1) list_stations();  // kind() looks there from now on
    return found;
}

/// A receiver's kind does not depend on its own rate, so that the index keeps the old kind.
void Stations::set_rate(NodeId node, BitRate rate) {
    Radio radio = this->radio(node);
    if (radio.rate == rate) return;
    radio.rate = rate;
    list_stations();
    Station& station = stations_[node.index()];
    station.kind = kinds_.add(radio, kinds_.model(station.kind)) & 0x7fffffff;
    const auto known = std::find(radios_.begin(), radios_.end(), radio);
    station.radio = static_cast<std::uint32_t>(known - radios_.begin());
    if (known == radios_.end()) radios_.push_back(std::move(radio));
}

void Stations::switch_radio(NodeId node, bool on) {
    list_stations();
    Station& station = stations_[node.index()];
    off_ += static_cast<std::size_t>(station.on) - static_cast<std::size_t>(on);
    station.on = on;
}

Vec3 Stations::antenna(NodeId node, Time t, const Legs& legs) const {
    Vec3 p = legs.position(node, t);
    p.z += height(node);
    return p;
}

Pose Stations::pose(NodeId node, Time t, const Legs& legs) const {
    return {antenna(node, t, legs), Radians{legs.leg(node).heading_at(t)}};
}

void Stations::measure(std::size_t begin, std::size_t end, const Legs& legs) {
    AntennaHeights antennas = kinds_.antennas();
    for (std::size_t i = begin; i < end; ++i) {
        const NodeId node{static_cast<std::uint32_t>(i)};
        antennas.take(legs.leg(node), {height(node)});
    }
    kinds_.set_antennas(antennas);
    measured_ = std::max(measured_, end);
}

}  // namespace rovernet
