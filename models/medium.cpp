// SPDX-License-Identifier: MIT
#include "models/medium.hpp"

#include "models/friis.hpp"
#include "models/link_range.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// More kinds of radios than this are not compared with each other for being alike.
constexpr std::size_t most_kinds = 64;

/// What a receiver adds to a link budget: gain - cable loss - sensitivity.
Db receiver_share(const Radio& radio) {
    return Db{-radio.sensitivity.value} + radio.antenna_gain - radio.cable_loss;
}

/// Rounded to the nearest nanosecond; `d` [m] >= 0.
Duration flight_time(double d) {
    return Duration{static_cast<std::int64_t>(d * (1e9 / speed_of_light) + 0.5)};
}

/// The place of `value` in `list`, added if it is not there yet.
template <class T>
std::uint32_t number_of(std::vector<T>& list, const T& value) {
    const auto found = std::find(list.begin(), list.end(), value);
    const auto place = static_cast<std::uint32_t>(found - list.begin());
    if (found == list.end()) list.push_back(value);
    return place;
}

Radio without_labels(Radio radio) {
    const Radio plain;
    radio.ip = plain.ip;
    radio.mac = plain.mac;
    radio.netmask = plain.netmask;
    radio.mode = plain.mode;
    radio.encryption = plain.encryption;
    radio.range_db = plain.range_db;
    return radio;
}

/// Whether a leg, or its copy in the index, stays where it is until it is replaced.
template <class AnyLeg>
bool at_rest(const AnyLeg& leg, Time t) {
    return leg.velocity == Vec3{} && t < leg.end;
}

}  // namespace

Membership Medium::membership(const Radio& radio) {
    return {.essid = number_of(essids_, radio.essid),
            .channel = number_of(channels_, {radio.channel, radio.frequency}),
            .gated = radio.gate == Gate::network};
}

std::uint32_t Medium::kind_of(const Radio& radio, std::uint32_t model) {
    const Radio plain = without_labels(radio);
    for (std::size_t i = 0; i < std::min(kinds_.size(), most_kinds); ++i) {
        if (kinds_[i].model != model || kinds_[i].radio != plain) continue;
        ++kinds_[i].stations;
        return static_cast<std::uint32_t>(i);
    }
    kinds_.push_back({.radio = plain,
                      .membership = membership(radio),
                      .model = model,
                      .noise = noise_floor(plain)});
    heights_.push_back(plain.antenna_height.value);
    const Membership& mine = kinds_.back().membership;
    // All match as long as all have the same network, or none is gated.
    gated_ = gated_ || (mine.gated && (essids_.size() > 2 || channels_.size() > 1));
    return static_cast<std::uint32_t>(kinds_.size() - 1);
}

void Medium::add(const Radio& radio, std::uint64_t key, const Propagation& propagation) {
    check_fields(radio, "radio");
    propagation.check_frequency(radio.frequency);
    if (radios_.empty() || radios_.back() != radio) radios_.push_back(radio);
    const std::uint32_t kind = kind_of(radio, number_of(models_, propagation));
    stations_.push_back({key, static_cast<std::uint32_t>(radios_.size() - 1), kind});
    index_.add(kind);
    cells_chosen_ = false;
    if (receiver_share(radio) > best_receiver_) {
        best_receiver_ = receiver_share(radio);
        for (auto& other : kinds_) other.reach2 = -1;
    }
    Radio silent;  // what a receiver adds is the budget of one that sends 0 dBm
    silent.power = Dbm{0};
    const Db sensor_share = audible_budget(silent, radio);
    if (sensor_share > best_sensor_) {
        best_sensor_ = sensor_share;
        for (auto& other : kinds_) other.sensed_reach2 = -1;
    }
}

void Medium::switch_radio(NodeId node, bool on) {
    bool& was_on = stations_[node.index()].on;
    off_ += static_cast<std::size_t>(was_on) - static_cast<std::size_t>(on);
    was_on = on;
}

Vec3 Medium::antenna(NodeId node, Time t, const Legs& legs) const {
    Vec3 p = legs.position(node, t);
    p.z += kind(node).radio.antenna_height.value;
    return p;
}

double Medium::squared_reach(const Kind& from, Db best_receiver) const {
    constexpr double slack = 1 + 1e-9;  // rounding of the model's inverse
    const Db budget = best_receiver + Db{from.radio.power.value} + from.radio.antenna_gain -
                      from.radio.cable_loss;
    const double reach = models_[from.model].reach(budget, from.radio.frequency).value * slack;
    return reach * reach;
}

double Medium::squared_reach(Kind& from) {
    if (from.reach2 < 0) from.reach2 = squared_reach(from, best_receiver_);
    return from.reach2;
}

double Medium::squared_sensed_reach(Kind& from) {
    if (from.sensed_reach2 < 0) from.sensed_reach2 = squared_reach(from, best_sensor_);
    return from.sensed_reach2;
}

/// For a model that goes by distance.
Medium::Ranges Medium::compute_ranges(const Kind& from, const Radio& to) const {
    const auto range2 = [&](Db budget) {
        return largest_squared_distance(models_[from.model], from.radio.frequency, budget);
    };
    return {.heard2 = range2(link_budget(from.radio, to)),
            .sensed2 = range2(sensing_budget(from.radio, to)),
            .audible2 = range2(audible_budget(from.radio, to))};
}

/// Cells as wide as the reach of the median station: most queries then look at nine of them.
void Medium::choose_cells() {
    std::vector<std::pair<double, std::uint32_t>> reaches;
    for (Kind& each : kinds_) reaches.emplace_back(std::sqrt(squared_reach(each)), each.stations);
    std::sort(reaches.begin(), reaches.end());
    std::size_t seen = 0, median = 0;
    while (2 * (seen += reaches[median].second) < stations_.size()) ++median;
    constexpr double widest = 1e9;  // [m] of models without a bound
    const double size = settings_.all_pairs ? widest : 1.1 * reaches[median].first;
    index_.set_cell_size(std::min(size, widest));
    cells_chosen_ = true;
}

LinkBatch Medium::batch(NodeId from, Vec3 origin) const {
    return {.frequency = radio(from).frequency,
            .from = origin,
            .to = {},
            .from_key = stations_[from.index()].key,
            .to_keys = {},
            .scene = settings_.scene,
            .floor_height = settings_.floor_height,
            .seed = settings_.seed,
            .replication = settings_.replication};
}

/// Calls use(entry, antenna, squared distance) for those within reach that are on and may link.
template <class Use>
void Medium::visit(NodeId from, double reach2, Time t, const Legs& legs, Use use) {
    if (!cells_chosen_) choose_cells();
    origin_ = antenna(from, t, legs);
    index_.visit(origin_, std::sqrt(reach2), t, legs, [&](const Entry& e, Vec3 p) {
        p.z += heights_[e.label];
        const double d2 = squared_distance(origin_, p);
        if (d2 > reach2 || e.node == from || !is_on(e.node)) return;
        if (gated_ && !may_link(from, e.node)) return;
        use(e, p, d2);
    });
}

/// Those whose link goes by distance alone and is up.
void Medium::find_in_range(NodeId from, Time t, const Legs& legs) {
    Kind& mine = kinds_[stations_[from.index()].kind];
    mine.ranges.resize(kinds_.size());
    visit(from, squared_reach(mine), t, legs, [&](const Entry& e, Vec3, double d2) {
        Ranges& ranges = mine.ranges[e.label];
        if (d2 > ranges.heard2) return;
        if (std::isnan(ranges.heard2)) {
            ranges = compute_ranges(mine, kinds_[e.label].radio);
            if (d2 > ranges.heard2) return;
        }
        found_.push_back({e.node, d2});
    });
}

/// Those whose link goes by distance and a draw of the pair, and is up.
void Medium::find_in_shadowed_range(NodeId from, const ShadowedLoss& loss, Time t,
                                    const Legs& legs) {
    Kind& mine = kinds_[stations_[from.index()].kind];
    mine.shadowed.resize(kinds_.size());
    const std::uint64_t key = stations_[from.index()].key;
    visit(from, squared_reach(mine), t, legs, [&](const Entry& e, Vec3, double d2) {
        auto& range = mine.shadowed[e.label];
        if (!range) {
            range.emplace(loss, link_budget(mine.radio, kinds_[e.label].radio),
                          shadowing_draws(settings_.seed, settings_.replication));
        }
        if (!range->in_range(d2, key, stations_[e.node.index()].key)) return;
        found_.push_back({e.node, d2});
    });
}

/// Gathers those within reach, with budget(radio) [dB] and the loss of each.
template <class Budget>
void Medium::find_losses(NodeId from, double reach2, Time t, const Legs& legs, Budget budget) {
    candidates_.clear();
    const bool rests = settings_.keep_losses && !settings_.all_pairs && at_rest(legs.leg(from), t);
    visit(from, reach2, t, legs, [&](const Entry& e, Vec3 p, double d2) {
        candidates_.add({.node = e.node,
                         .rests = rests && at_rest(e, t),
                         .key = stations_[e.node.index()].key,
                         .antenna = p,
                         .squared_distance = d2,
                         .budget_db = budget(kinds_[e.label].radio).value});
    });
    candidates_.compute_losses(model(from), batch(from, origin_), from, pairs_);
}

/// Those whose link is up, whatever decides it.
void Medium::find_in_reach(NodeId from, Time t, const Legs& legs) {
    Kind& mine = kinds_[stations_[from.index()].kind];
    find_losses(from, squared_reach(mine), t, legs,
                [&](const Radio& to) { return link_budget(mine.radio, to); });
    for (const Candidate& c : candidates_.all()) {
        if (c.loss_db > c.budget_db) continue;
        found_.push_back({c.node, c.squared_distance});
    }
}

void Medium::find_hearers(NodeId from, Time t, const Legs& legs) {
    found_.clear();
    if (model(from).shape() == LossShape::by_distance) return find_in_range(from, t, legs);
    // A table costs time and memory: it pays where many radios are alike.
    constexpr std::size_t most_tables = 16;
    if (kinds_.size() <= most_tables) {
        if (const auto loss = model(from).shadowed_loss(radio(from).frequency)) {
            return find_in_shadowed_range(from, *loss, t, legs);
        }
    }
    find_in_reach(from, t, legs);
}

/// Those that sense `from` over a link that goes by distance alone.
void Medium::find_sensed_in_range(NodeId from, Time t, const Legs& legs) {
    Kind& mine = kinds_[stations_[from.index()].kind];
    mine.ranges.resize(kinds_.size());
    visit(from, squared_sensed_reach(mine), t, legs, [&](const Entry& e, Vec3, double d2) {
        Ranges& ranges = mine.ranges[e.label];
        if (d2 > ranges.audible2) return;
        if (std::isnan(ranges.audible2)) {
            ranges = compute_ranges(mine, kinds_[e.label].radio);
            if (d2 > ranges.audible2) return;
        }
        auto& hearers = d2 <= ranges.heard2 ? receivers_ : sensors_;
        hearers.push_back({e.node, delay(std::sqrt(d2)), d2, Ranges::nan, d2 <= ranges.sensed2});
    });
}

/// Those that sense `from`, whatever decides it.
void Medium::find_sensed_in_reach(NodeId from, Time t, const Legs& legs) {
    Kind& mine = kinds_[stations_[from.index()].kind];
    find_losses(from, squared_sensed_reach(mine), t, legs,
                [&](const Radio& to) { return audible_budget(mine.radio, to); });
    for (const Candidate& c : candidates_.all()) {
        if (c.loss_db > c.budget_db) continue;
        const Radio& theirs = kind(c.node).radio;
        auto& hearers = c.loss_db <= link_budget(mine.radio, theirs).value ? receivers_ : sensors_;
        const bool senses = c.loss_db <= sensing_budget(mine.radio, theirs).value;
        hearers.push_back(
            {c.node, delay(std::sqrt(c.squared_distance)), c.squared_distance, c.loss_db, senses});
    }
}

Medium::Hearers Medium::sensed(NodeId from, Time t, const Legs& legs) {
    receivers_.clear();
    sensors_.clear();
    if (model(from).shape() == LossShape::by_distance) {
        find_sensed_in_range(from, t, legs);
    } else {
        find_sensed_in_reach(from, t, legs);
    }
    std::sort(receivers_.begin(), receivers_.end(), [](const Hearer& a, const Hearer& b) {
        return a.delay != b.delay ? a.delay < b.delay : a.node < b.node;
    });
    return {receivers_, sensors_};
}

Dbm Medium::level(NodeId from, NodeId to, double squared_distance) const {
    return level_after(from, to, loss(from, to, {}, {std::sqrt(squared_distance), 0, 0}));
}

/// The weakest signal [dBm] that disturbs `to`, if there is a cut.
Dbm Medium::weakest_audible(const Radio& to) const {
    constexpr Db below_noise{10};
    return std::max(to.sensitivity - *settings_.interference_cut, noise_floor(to) - below_noise);
}

/// The largest path loss [dB] at which `to` is disturbed by `from`.
Db Medium::audible_budget(const Radio& from, const Radio& to) const {
    const Db sensed = sensing_budget(from, to);
    if (!settings_.interference_cut) return sensed;
    return std::max(sensed, link_budget(from, to) + (to.sensitivity - weakest_audible(to)));
}

Db Medium::left_out(std::size_t frames) const {
    assert(settings_.interference_cut);
    Db most{0};
    for (const Kind& each : kinds_) {
        const Db above_noise = weakest_audible(each.radio) - each.noise;
        const double sum = 1 + static_cast<double>(frames) * math::exp10(above_noise.value / 10);
        most = std::max(most, Db{10 * math::log10(sum)});
    }
    return most;
}

Duration Medium::delay(double distance) const {
    return settings_.propagation_delay ? flight_time(distance) : Duration{0};
}

void Medium::receivers(NodeId from, Time start, Time end, const Legs& legs,
                       std::vector<Reception>& out) {
    find_hearers(from, start, legs);
    // One number to sort by: the delay, then the node.
    order_.resize(found_.size());
    std::uint64_t longest = 0;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const Duration under_way = delay(std::sqrt(found_[i].squared_distance));
        const auto count = static_cast<std::uint64_t>(under_way.count());
        longest = std::max(longest, count);
        order_[i] = count << 32 | found_[i].node.value;
    }
    if (longest >> 32 != 0) return late_receivers(end, out);
    std::sort(order_.begin(), order_.end());
    const std::size_t first = out.size();
    out.resize(first + order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const Duration under_way{static_cast<std::int64_t>(order_[i] >> 32)};
        out[first + i].node = NodeId{static_cast<std::uint32_t>(order_[i])};
        out[first + i].time = end + under_way;
    }
}

/// As receivers(), of those found, some of which are more than four light seconds away.
void Medium::late_receivers(Time end, std::vector<Reception>& out) const {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    for (const Found& f : found_) {
        out.push_back({.node = f.node, .time = end + delay(std::sqrt(f.squared_distance))});
    }
    std::sort(out.begin() + first, out.end(), [](const Reception& a, const Reception& b) {
        return a.time != b.time ? a.time < b.time : a.node < b.node;
    });
}

std::uint32_t Medium::reachable(NodeId from, Time t, const Legs& legs) {
    std::vector<bool> seen(stations_.size());
    std::vector<NodeId> frontier{from};
    seen[from.index()] = true;
    const std::size_t all = stations_.size() - off_ + (is_on(from) ? 0 : 1);
    for (std::size_t next = 0; next < frontier.size() && frontier.size() < all; ++next) {
        find_hearers(frontier[next], t, legs);
        for (const auto [node, squared_distance] : found_) {
            if (seen[node.index()]) continue;
            seen[node.index()] = true;
            frontier.push_back(node);
        }
    }
    return static_cast<std::uint32_t>(frontier.size() - 1);
}

bool Medium::link_up(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return from != to && is_on(from) && is_on(to) && may_link(from, to) &&
           path_loss(from, to, t, legs) <= link_budget(radio(from), radio(to));
}

Db Medium::path_loss(NodeId from, NodeId to, Time t, const Legs& legs) const {
    return {loss(from, to, antenna(from, t, legs), antenna(to, t, legs))};
}

/// Path loss [dB] from `from` here to `to` there.
double Medium::loss(NodeId from, NodeId to, Vec3 here, Vec3 there) const {
    LinkBatch link = batch(from, here);
    link.to = {&there, 1};
    link.to_keys = {&stations_[to.index()].key, 1};
    double db = 0;
    model(from).loss(link, Db{infinity}, {&db, 1});
    return db;
}

}  // namespace rovernet
