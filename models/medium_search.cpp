// SPDX-License-Identifier: MIT
// Who is within reach: what every transmission asks.
#include "models/friis.hpp"
#include "models/medium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

/// Rounded to the nearest nanosecond; `d` [m] >= 0.
Duration flight_time(double d) {
    return Duration{static_cast<std::int64_t>(d * (1e9 / speed_of_light) + 0.5)};
}

/// Whether a leg, or its copy in the index, stays where it is until it is replaced.
template <class AnyLeg>
bool at_rest(const AnyLeg& leg, Time t) {
    return leg.velocity == Vec3{} && t < leg.end;
}

}  // namespace

/// Cells as wide as the reach of the median station: most queries then look at nine of them.
void Medium::choose_cells() {
    std::vector<std::pair<double, std::size_t>> reaches;
    for (Kind k = 0; k < kinds_.size(); ++k) {
        const double reach2 = kinds_.squared_reach(k, Strength::decodable);
        reaches.emplace_back(std::sqrt(reach2), kinds_.stations(k));
    }
    std::sort(reaches.begin(), reaches.end());
    std::size_t seen = 0, median = 0;
    while (2 * (seen += reaches[median].second) < stations_.size()) ++median;
    constexpr double widest = 1e9;  // [m] of models without a bound
    const double size = settings_.all_pairs ? widest : 1.1 * reaches[median].first;
    index_.set_cell_size(std::min(size, widest));
    cells_chosen_ = true;
}

/// Makes the index about `from` at `t`.
void Medium::look_from(NodeId from, Time t, const Legs& legs) {
    if (!cells_chosen_) choose_cells();
    index_.refresh(t, legs);
    origin_ = index_.position_of(from, t, legs);
    origin_.z += kinds_.height(kind(from));
}

/// For the index: calls use(entry, antenna, squared distance) for those within reach that are on
/// and may link.
template <class Use>
auto Medium::within(NodeId from, double reach2, Use use) const {
    return [=, this, mine = kind(from)](const Entry& e, Vec3 p) {
        p.z += kinds_.height(e.label);
        const double d2 = squared_distance(origin_, p);
        if (d2 > reach2 || e.node == from || !is_on(e.node)) return;
        if (!kinds_.may_link(mine, e.label)) return;
        use(e, p, d2);
    };
}

template <class Use>
void Medium::visit(NodeId from, double reach2, Time t, const Legs& legs, Use use) {
    look_from(from, t, legs);
    index_.visit(origin_, std::sqrt(reach2), t, legs, within(from, reach2, use));
}

/// Those for whom a signal of `from` is strong enough: in found_ who can decode it, in sensors_ the
/// others.
void Medium::find(NodeId from, Strength strength, Time t, const Legs& legs) {
    found_.clear();
    sensors_.clear();
    kinds_.prepare(kind(from));
    switch (kinds_.decision(kind(from))) {
        case Decision::by_range: return find_in_range(from, strength, t, legs);
        case Decision::by_table: return find_in_table(from, strength, t, legs);
        case Decision::by_loss: return find_in_reach(from, strength, t, legs);
    }
}

void Medium::find_in_range(NodeId from, Strength strength, Time t, const Legs& legs) {
    const Kind mine = kind(from);
    const double reach2 = kinds_.squared_reach(mine, strength);
    visit(from, reach2, t, legs, [&](const Entry& e, Vec3, double d2) {
        if (kinds_.in_range(mine, e.label, Strength::decodable, d2)) {
            found_.push_back({e.node, d2});
        } else if (strength != Strength::decodable &&
                   kinds_.in_range(mine, e.label, strength, d2)) {
            sensors_.push_back({e.node, d2});
        }
    });
}

void Medium::find_in_table(NodeId from, Strength strength, Time t, const Legs& legs) {
    look_from(from, t, legs);
    const Kind mine = kind(from);
    const std::uint64_t key = stations_[from.index()].key;
    const auto in_range = [&](const Entry& e, double d2, Strength s) {
        return kinds_.table(mine, e.label, s).in_range(d2, key, stations_[e.node.index()].key);
    };
    const auto use = [&](const Entry& e, Vec3, double d2) {
        if (!in_range(e, d2, strength)) return;
        // Who can decode it senses it, too.
        const bool decodes =
            strength == Strength::decodable || in_range(e, d2, Strength::decodable);
        (decodes ? found_ : sensors_).push_back({e.node, d2});
    };
    // Their draws rule out most before anything else about them is looked at.
    const PairDraws draws = shadowing_draws(settings_.seed, settings_.replication);
    const std::uint64_t share = draws.share(key);
    if (std::exchange(shares_of_bin_, index_.bins()) != index_.bins()) share_draws(draws);
    const ShadowedRange* const only = kinds_.size() == 1 ? &kinds_.table(0, 0, strength) : nullptr;
    const std::uint64_t* const shares = shares_.data();
    const auto passes = [=, this](std::uint32_t place, double at_least) {
        const std::uint64_t bits = PairDraws::bits_of_shares(share, shares[place]);
        if (only) return only->may_be_in_range(at_least, bits);
        return kinds_.table(mine, index_.entries()[place].label, strength)
            .may_be_in_range(at_least, bits);
    };
    const double reach2 = kinds_.squared_reach(mine, strength);
    index_.visit_if(origin_, std::sqrt(reach2), t, legs, passes, within(from, reach2, use));
}

/// Fills shares_.
void Medium::share_draws(const PairDraws& draws) {
    shares_.clear();
    for (const Entry& e : index_.entries()) {
        shares_.push_back(draws.share(stations_[e.node.index()].key));
    }
}

void Medium::find_in_reach(NodeId from, Strength strength, Time t, const Legs& legs) {
    const Radio& mine = kinds_.radio(kind(from));
    const bool rests = settings_.keep_losses && !settings_.all_pairs && at_rest(legs.leg(from), t);
    candidates_.clear();
    visit(from, kinds_.squared_reach(kind(from), strength), t, legs,
          [&](const Entry& e, Vec3 p, double d2) {
              const Db budget = kinds_.budget(strength, mine, kinds_.radio(e.label));
              candidates_.add({.node = e.node,
                               .rests = rests && at_rest(e, t),
                               .key = stations_[e.node.index()].key,
                               .antenna = p,
                               .squared_distance = d2,
                               .budget_db = budget.value});
          });
    candidates_.compute_losses(model(from), batch(from, origin_), from, pairs_);
    for (const Candidate& c : candidates_.all()) {
        if (c.loss_db > c.budget_db) continue;
        const bool decodable = strength == Strength::decodable ||
                               c.loss_db <= link_budget(mine, kinds_.radio(kind(c.node))).value;
        (decodable ? found_ : sensors_).push_back({c.node, c.squared_distance});
    }
}

/// As arrival(), within the reach of the frame.
std::optional<Arrival> Medium::arrival_from(const Emission& frame, double d2, NodeId to,
                                            Vec3 there) {
    const Kind mine = kind(frame.from), theirs = kind(to);
    if (!kinds_.may_link(mine, theirs)) return std::nullopt;
    double level_dbm = std::numeric_limits<double>::quiet_NaN();
    kinds_.prepare(mine);
    switch (kinds_.decision(mine)) {
        case Decision::by_range:
            if (!kinds_.in_range(mine, theirs, Strength::disturbing, d2)) return std::nullopt;
            break;
        case Decision::by_table: {
            const auto& table = kinds_.table(mine, theirs, Strength::disturbing);
            const std::uint64_t key = stations_[frame.from.index()].key;
            if (!table.in_range(d2, key, stations_[to.index()].key)) return std::nullopt;
            break;
        }
        case Decision::by_loss: {
            const Radio &sender = kinds_.radio(mine), &receiver = kinds_.radio(theirs);
            const Db most = kinds_.budget(Strength::disturbing, sender, receiver);
            const Db lost{loss(frame.from, to, frame.origin, there, most)};
            if (lost > most) return std::nullopt;
            level_dbm = received_power(sender, receiver, lost).value;
        }
    }
    const Duration under_way = delay(std::sqrt(d2));
    return Arrival{.begin = frame.begin + under_way,
                   .end = frame.end + under_way,
                   .level_dbm = level_dbm,
                   .squared_distance = d2,
                   .from = frame.from};
}

Dbm Medium::level(const Arrival& arrival, NodeId to) const {
    const Vec3 there{std::sqrt(arrival.squared_distance), 0, 0};
    const Db lost{loss(arrival.from, to, {}, there, Db{std::numeric_limits<double>::infinity()})};
    return received_power(kinds_.radio(kind(arrival.from)), kinds_.radio(kind(to)), lost);
}

Duration Medium::delay(double distance) const {
    return settings_.propagation_delay ? flight_time(distance) : Duration{0};
}

void Medium::receivers(NodeId from, Time start, Time end, const Legs& legs,
                       std::vector<Reception>& out) {
    find(from, Strength::decodable, start, legs);
    sort_receivers(end, out);
}

std::span<const Medium::Found> Medium::sensors(NodeId from, Time start, Time end, const Legs& legs,
                                               std::vector<Reception>& receivers) {
    find(from, Strength::detectable, start, legs);
    sort_receivers(end, receivers);
    return sensors_;
}

double Medium::heard_within() const {
    double most = 0;
    for (const Found& f : found_) most = std::max(most, f.squared_distance);
    return std::sqrt(most);
}

/// Appends those found, in the order in which a frame that ends at `end` ends at them.
void Medium::sort_receivers(Time end, std::vector<Reception>& out) {
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
    const std::size_t first = out.size();
    out.resize(first + order_.size());
    const auto put = [&](std::size_t place, std::uint64_t key) {
        const Duration under_way{static_cast<std::int64_t>(key >> 32)};
        out[first + place].node = NodeId{static_cast<std::uint32_t>(key)};
        out[first + place].time = end + under_way;
    };
    // To count the lesser ones of each takes more comparisons than to sort, and no branch that
    // goes either way: faster among few.
    constexpr std::size_t few = 32;
    if (order_.size() <= few) {
        for (const std::uint64_t key : order_) {
            std::size_t lesser = 0;
            for (const std::uint64_t other : order_) lesser += other < key;
            put(lesser, key);
        }
        return;
    }
    std::sort(order_.begin(), order_.end());
    for (std::size_t i = 0; i < order_.size(); ++i) put(i, order_[i]);
}

/// As sort_receivers(), of those found, some of which are more than four light seconds away.
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
        find(frontier[next], Strength::decodable, t, legs);
        for (const auto [node, squared_distance] : found_) {
            if (seen[node.index()]) continue;
            seen[node.index()] = true;
            frontier.push_back(node);
        }
    }
    return static_cast<std::uint32_t>(frontier.size() - 1);
}

}  // namespace rovernet
