// SPDX-License-Identifier: MIT
#include "models/medium/radio_kinds.hpp"

#include <algorithm>
#include <cassert>

namespace rovernet {
namespace {

/// Largest number of kinds that are compared with a new radio.
constexpr std::size_t most_compared = 64;

/// Index of `value` in `list`; the value is appended if it is missing.
template <class T>
std::uint32_t number_of(std::vector<T>& list, const T& value) {
    const auto found = std::find(list.begin(), list.end(), value);
    const auto place = static_cast<std::uint32_t>(found - list.begin());
    if (found == list.end()) list.push_back(value);
    return place;
}

Radio without_labels(Radio radio) {
    radio.labels = {};
    return radio;
}

/// Whether the loss depends on distance alone between antennas of one height, and only there.
bool needs_level(const Propagation& model) {
    return model.shape() == LossShape::by_heights && !model.is_random();
}

}  // namespace

Decision RadioKinds::cheapest_decision(const Propagation& model, Hertz frequency) const {
    const bool is_level = needs_level(model) && antennas_.are_equal;
    if (model.shape() == LossShape::by_distance || is_level) return Decision::by_range;
    return model.shadowed_loss(frequency) ? Decision::by_table : Decision::by_loss;
}

Membership RadioKinds::membership(const Radio& radio) {
    return {.essid = number_of(essids_, radio.essid),
            .channel = number_of(channels_, {radio.channel, radio.frequency}),
            .gated = radio.gate == Gate::network};
}

RadioKinds::Kind RadioKinds::add(const Radio& radio, const Propagation& propagation) {
    const Radio plain = without_labels(radio);
    const std::uint32_t model = number_of(models_, propagation);
    for (std::size_t i = 0; i < std::min(kinds_.size(), most_compared); ++i) {
        if (kinds_[i].model != model || kinds_[i].radio != plain || kinds_[i].stations == 0)
            continue;
        ++kinds_[i].stations;
        return static_cast<Kind>(i);
    }
    kinds_.push_back({.radio = plain,
                      .coding = phy_.coding(plain.rate).value_or(Coding{}),
                      .membership = membership(radio),
                      .model = model,
                      .cheapest = cheapest_decision(propagation, plain.frequency),
                      .noise = noise_floor(plain)});
    heights_.push_back(plain.antenna_height.value);
    heights_matter_ =
        heights_matter_ || propagation.is_bounded_by_height() || needs_level(propagation);
    directional_ = directional_ || radio.is_directional();
    varies_ = varies_ || directional_;
    // All match while all have the same network, or none is gated.
    const bool gated = kinds_.back().membership.gated;
    gated_ = gated_ || (gated && (essids_.size() > 2 || channels_.size() > 1));
    const Radio sender{.power = Dbm{0}, .antenna_gain = Db{0}, .cable_loss = Db{0}};
    for (const Strength s : strengths) {
        Db& best = best_budget_[static_cast<std::size_t>(s)];
        const Db mine =
            budget(s, sender, plain, LinkGain::most(sender, plain), best_sensitivity(plain));
        if (mine <= best) continue;
        best = mine;
        for (Alike& each : kinds_) each.reach2[s] = unknown;
    }
    return static_cast<Kind>(kinds_.size() - 1);
}

RadioKinds::Kind RadioKinds::of_coding(Kind kind, Coding coding) {
    if (kinds_[kind].coding == coding) return kind;
    for (Kind k = 0; k < kinds_.size(); ++k) {
        const Alike& each = kinds_[k];
        if (each.coding == coding && each.model == kinds_[kind].model &&
            each.radio == kinds_[kind].radio)
            return k;
    }
    const Alike& mine = kinds_[kind];
    Alike other{.radio = mine.radio,
                .coding = coding,
                .membership = mine.membership,
                .model = mine.model,
                .cheapest = mine.cheapest,
                .noise = mine.noise,
                .stations = 0};
    kinds_.push_back(std::move(other));
    heights_.push_back(heights_[kind]);
    return static_cast<Kind>(kinds_.size() - 1);
}

Dbm RadioKinds::best_sensitivity(const Radio& radio) const {
    Dbm best = radio.sensitivity;
    if (!phy_.has_sensitivities()) return best;
    for (const BitRate rate : phy_.rates()) {
        best = std::min(best, phy_.sensitivity(radio, *phy_.coding(rate)));
    }
    return best;
}

Db RadioKinds::budget(Strength strength, Kind from, Kind to, LinkGain gain) const {
    const Radio& receiver = kinds_[to].radio;
    return budget(strength, kinds_[from].radio, receiver, gain,
                  phy_.sensitivity(receiver, kinds_[from].coding));
}

Db RadioKinds::budget(Strength strength, Kind from, Kind to) const {
    return budget(strength, from, to, LinkGain::most(kinds_[from].radio, kinds_[to].radio));
}

Db RadioKinds::budget(Strength strength, const Radio& from, const Radio& to, LinkGain gain,
                      Dbm sensitivity) const {
    const Db plain = link_budget(from, to, gain);
    const Db decodable = plain + (to.sensitivity - sensitivity);
    if (strength == Strength::decodable) return decodable;
    const Db detectable = std::max(decodable, sensing_budget(from, to, gain));
    if (strength == Strength::detectable || !interference_cut_) return detectable;
    return std::max(detectable, plain + (to.sensitivity - weakest_interfering(to)));
}

Dbm RadioKinds::weakest_interfering(const Radio& to) const {
    assert(interference_cut_);
    constexpr Db below_noise{10};
    return std::max(to.sensitivity - *interference_cut_, noise_floor(to) - below_noise);
}

Db RadioKinds::left_out(std::size_t frames) const {
    Db most{0};
    for (const Alike& each : kinds_) {
        const Db above_noise = weakest_interfering(each.radio) - each.noise;
        const double sum = 1 + static_cast<double>(frames) * math::exp10(above_noise.value / 10);
        most = std::max(most, Db{10 * math::log10(sum)});
    }
    return most;
}

void RadioKinds::set_antennas(const AntennaHeights& heights) {
    const bool is_higher = heights.highest != antennas_.highest;
    const bool differ_now = antennas_.are_equal && !heights.are_equal;
    antennas_ = heights;
    if (!is_higher && !differ_now) return;
    for (Alike& each : kinds_) {
        if (is_higher) each.reach2 = {};
        if (differ_now)
            each.cheapest = cheapest_decision(models_[each.model], each.radio.frequency);
    }
}

const FirstLook& RadioKinds::first_look(Kind from, Strength strength) {
    auto& look = kinds_[from].looks[static_cast<std::size_t>(strength)];
    if (!look) look = make_look(from, strength);
    return *look;
}

double RadioKinds::squared_reach(Kind from, Strength strength) {
    constexpr double slack = 1 + 1e-9;  // rounding of the model's inverse
    double& reach2 = kinds_[from].reach2[strength];
    if (std::isnan(reach2)) {
        const Radio& sender = radio(from);
        const Db most = best_budget_[static_cast<std::size_t>(strength)] + Db{sender.power.value} +
                        LinkGain::most(sender, sender).sender + most_fade_;
        const double reach =
            model(from).reach(most, sender.frequency, antennas_.highest).value * slack;
        reach2 = reach * reach;
    }
    return reach2;
}

/// Extends the lists of a kind for all other kinds.
void RadioKinds::make_room(Kind from) {
    Alike& mine = kinds_[from];
    mine.prepared_for = kinds_.size();
    if (mine.cheapest == Decision::by_range) mine.range2.resize(kinds_.size());
    if (decision(from) == Decision::by_table) {
        mine.tables.resize(kinds_.size());
        mine.looks.assign(strengths.size(), std::nullopt);
    }
}

double RadioKinds::compute_range(Kind from, Kind to, Strength strength) {
    const Radio& sender = radio(from);
    const double range2 = largest_squared_distance(model(from), sender.frequency,
                                                   budget(strength, from, to), antennas_.first);
    return kinds_[from].range2[to][strength] = range2;
}

ShadowedRange RadioKinds::make_table(Kind from, Kind to, Strength strength) const {
    const Radio& sender = radio(from);
    return {*model(from).shadowed_loss(sender.frequency), budget(strength, from, to)};
}

FirstLook RadioKinds::make_look(Kind from, Strength strength) {
    FirstLook look(squared_reach(from, strength));
    for (Kind to = 0; to < size(); ++to) look.let_pass(table(from, to, strength));
    return look;
}

}  // namespace rovernet
