// SPDX-License-Identifier: MIT
// Who is within reach: what every transmission asks.
#include "models/medium/medium.hpp"
#include "sim/units.hpp"

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

/// Stays where it is until its leg is replaced.
bool rests(const Leg& leg, Time t) { return leg.velocity == Vec3{} && t < leg.end; }

}  // namespace

/// Takes note of how high the antennas of nodes `begin` to `end` get on their legs, if heights
/// matter.
void Medium::measure(std::size_t begin, std::size_t end, const Legs& legs) {
    if (!kinds_.heights_matter()) return;
    for (std::size_t i = begin; i < end; ++i) {
        const NodeId node{static_cast<std::uint32_t>(i)};
        const Leg leg = legs.leg(node);
        const bool climbs_on = leg.end == never && leg.velocity.z > 0;
        const double top = climbs_on ? std::numeric_limits<double>::infinity()
                                     : std::max(leg.from.z, leg.to.z) + kinds_.height(kind(node));
        if (top > kinds_.highest().value) kinds_.set_highest({top});
    }
    measured_ = std::max(measured_, end);
}

/// Cells as wide as the reach of the median station: most queries then look at nine of them.
void Medium::choose_cells() {
    std::vector<std::pair<double, std::size_t>> reaches;
    for (Kind k = 0; k < kinds_.size(); ++k) {
        const double reach2 = kinds_.squared_reach(k, Strength::decodable);
        reaches.emplace_back(std::sqrt(reach2), kinds_.stations(k));
    }
    std::sort(reaches.begin(), reaches.end());
    std::size_t seen = 0, median = 0;
    while (2 * (seen += reaches[median].second) < keys_.size()) ++median;
    constexpr double widest = 1e9;  // [m] of models without a bound
    const double size = settings_.all_pairs ? widest : 1.1 * reaches[median].first;
    index_.set_cell_size(std::min(size, widest));
    cells_chosen_ = true;
}

/// Makes the index about `from` at `t`.
void Medium::look_from(NodeId from, Time t, const Legs& legs) {
    if (!cells_chosen_) {
        measure(measured_, keys_.size(), legs);
        choose_cells();
    }
    index_.refresh(t, legs);
    origin_ = index_.position_of(from, t, legs);
    origin_.z += kinds_.height(kind(from));
}

/// For the index: calls use(entry, antenna, squared distance and, if the index tells it, place) for
/// those within reach that are on and may link.
template <class Use>
auto Medium::within(NodeId from, double reach2, Use use) const {
    return [=, this, mine = kind(from)](const Entry& e, Vec3 p, auto... place) {
        p.z += kinds_.height(e.label);
        const double d2 = squared_distance(origin_, p);
        if (d2 > reach2 || e.node == from || !is_on(e.node)) return;
        if (!kinds_.may_link(mine, e.label)) return;
        use(e, p, d2, place...);
    };
}

template <class Use>
void Medium::visit(NodeId from, double reach2, Time t, const Legs& legs, Use use) {
    look_from(from, t, legs);
    index_.visit(origin_, std::sqrt(std::max(reach2, 0.0)), t, legs, within(from, reach2, use));
}

/// Those for whom a signal of `from` is strong enough: in found_ who can decode it, in sensors_ the
/// others.
void Medium::find(NodeId from, Strength strength, Time t, const Legs& legs, std::uint64_t frame) {
    const std::tuple search{from, strength, t, changes_};
    // A message is sent where it was asked for; but that had no fade.
    if (std::exchange(last_, search) == search && !fades_) return;
    found_.clear();
    sensors_.clear();
    kinds_.prepare(kind(from));
    switch (kinds_.decision(kind(from))) {
        case Decision::by_range:
            return kinds_.size() == 1 && strength == Strength::decodable
                       ? find_alike(from, t, legs)
                       : find_in_range(from, strength, t, legs);
        case Decision::by_table: return find_in_table(from, strength, t, legs);
        case Decision::by_loss: return find_in_reach(from, strength, t, legs, frame);
    }
}

void Medium::find_in_range(NodeId from, Strength strength, Time t, const Legs& legs) {
    const Kind mine = kind(from);
    const auto in_range = [&](const Entry& e, Strength s, double d2) {
        return d2 <= kinds_.squared_range(mine, e.label, s);
    };
    visit(from, kinds_.squared_reach(mine, strength), t, legs,
          [&](const Entry& e, Vec3, double d2) {
              const bool decodes = in_range(e, Strength::decodable, d2);
              if (!decodes && !in_range(e, strength, d2)) return;
              (decodes ? found_ : sensors_).put({e.node, d2}, true);
          });
}

/// As find_in_range(), of stations that are all of one kind and so in one network, for those that
/// decode.
void Medium::find_alike(NodeId from, Time t, const Legs& legs) {
    look_from(from, t, legs);
    const Kind mine = kind(from);
    const double range2 = kinds_.squared_range(mine, mine, Strength::decodable);
    const auto places = index_.near(origin_, std::sqrt(std::max(range2, 0.0)), t);
    Found* next = found_.room(places.size() + index_.apart());
    // Copies, which nothing that is written here can change.
    const auto visit = [&next, from, range2, origin = origin_, height = kinds_.height(mine),
                        off = all_are_on() ? nullptr : stations_.data()](const Entry& e, Vec3 p) {
        p.z += height;
        const double d2 = squared_distance(origin, p);
        const bool on = !off || off[e.node.index()].on;
        *next = {e.node, d2};
        next += (d2 <= range2) & (e.node != from) & on;
    };
    index_.visit(places, t, legs, visit);
    found_.keep_to(next);
}

void Medium::find_in_table(NodeId from, Strength strength, Time t, const Legs& legs) {
    look_from(from, t, legs);
    const Kind mine = kind(from);
    const std::uint64_t share = draws_.share(key(from));
    const auto use = [&](const Entry& e, Vec3, double d2, std::uint32_t place) {
        const std::uint64_t theirs =
            place == NeighbourIndex::nowhere ? draws_.share(key(e.node)) : shares_[place];
        const std::uint64_t bits = PairDraws::bits_of_shares(share, theirs);
        const auto in_range = [&](Strength s) {
            return kinds_.table(mine, e.label, s).in_range(d2, bits);
        };
        if (!in_range(strength)) return;
        // Who can decode it senses it, too.
        const bool decodes = strength == Strength::decodable || in_range(Strength::decodable);
        (decodes ? found_ : sensors_).put({e.node, d2}, true);
    };
    // Their draws rule out most before anything else about them is looked at.
    if (std::exchange(shares_of_bin_, index_.bins()) != index_.bins()) share_draws();
    const FirstLook& look = kinds_.first_look(mine, strength);
    const auto passes = [share, &look, shares = shares_.data()](std::uint32_t place,
                                                                float at_least) {
        return look.passes(at_least, PairDraws::bits_of_shares(share, shares[place]));
    };
    const double reach2 = kinds_.squared_reach(mine, strength);
    index_.visit_if(origin_, std::sqrt(reach2), t, legs, passes, within(from, reach2, use));
}

/// Fills shares_.
void Medium::share_draws() {
    shares_.clear();
    for (const Entry& e : index_.entries()) shares_.push_back(draws_.share(key(e.node)));
}

void Medium::find_in_reach(NodeId from, Strength strength, Time t, const Legs& legs,
                           std::uint64_t frame) {
    measure(measured_, keys_.size(), legs);  // the reach depends on it
    const Radio& mine = kinds_.radio(kind(from));
    const bool fixed = settings_.keep_losses && !settings_.all_pairs && rests(legs.leg(from), t);
    candidates_.clear();
    visit(from, kinds_.squared_reach(kind(from), strength), t, legs,
          [&](const Entry& e, Vec3 p, double d2) {
              const Db budget =
                  kinds_.budget(strength, mine, kinds_.radio(e.label), gain(from, e.node, t, legs));
              candidates_.add({.node = e.node,
                               .rests = fixed && !e.moves,
                               .key = key(e.node),
                               .antenna = p,
                               .squared_distance = d2,
                               .budget_db = budget.value});
          });
    const Db told = candidates_.compute_losses(model(from), batch(from, origin_, t, frame), from,
                                               pairs_, fades_ ? fades_->most() : Db{0});
    // A loss without walls is computed as fast as it is found again.
    const LossShape shape = model(from).shape();
    const bool keeps =
        keeps_recent_losses() && (shape == LossShape::by_walls || shape == LossShape::unknown);
    for (const Candidate& c : candidates_.all()) {
        if (keeps) recent_.keep({from, c.node, origin_, c.antenna}, told, c.loss_db);
        const double loss_db = faded(c.loss_db, from, c.node, origin_, c.antenna, frame);
        if (loss_db > c.budget_db) continue;
        const auto budget = [&] {
            return link_budget(mine, kinds_.radio(kind(c.node)), gain(from, c.node, t, legs));
        };
        const bool decodes = strength == Strength::decodable || loss_db <= budget().value;
        (decodes ? found_ : sensors_).put({c.node, c.squared_distance}, true);
    }
}

Arrival Medium::arrival_of(const Emission& frame, double d2, double level_dbm) const {
    const Duration under_way = delay(std::sqrt(d2));
    return {.begin = frame.begin + under_way,
            .end = frame.end + under_way,
            .level_dbm = level_dbm,
            .squared_distance = d2,
            .from = frame.from};
}

std::optional<Arrival> Medium::arrival_by_loss(const Emission& frame, double d2, NodeId to,
                                               Vec3 there, const Headings& headings) const {
    const Radio &sender = kinds_.radio(kind(frame.from)), &receiver = kinds_.radio(kind(to));
    const LinkGain gain = LinkGain::of(sender, receiver, [&] {
        return std::pair{Pose{frame.origin, headings.from}, Pose{there, headings.to}};
    });
    const Db most = kinds_.budget(Strength::interfering, sender, receiver, gain);
    const std::uint64_t key = frame_key(frame.from, frame.begin);
    const Db lost{loss(frame.from, to, frame.origin, there, frame.begin, key, most)};
    if (lost > most) return std::nullopt;
    return arrival_of(frame, d2, received_power(sender, lost, gain).value);
}

/// As arrival(), within the reach of the frame.
std::optional<Arrival> Medium::arrival_from(const Emission& frame, double d2, NodeId to,
                                            Vec3 there) {
    const Kind mine = kind(frame.from), theirs = kind(to);
    if (!kinds_.may_link(mine, theirs)) return std::nullopt;
    kinds_.prepare(mine);
    switch (kinds_.decision(mine)) {
        case Decision::by_range:
            if (d2 > kinds_.squared_range(mine, theirs, Strength::interfering)) return std::nullopt;
            break;
        case Decision::by_table: {
            const auto& table = kinds_.table(mine, theirs, Strength::interfering);
            if (!table.in_range(d2, draws_.bits(key(frame.from), key(to)))) return std::nullopt;
            break;
        }
        case Decision::by_loss: return arrival_by_loss(frame, d2, to, there, {});
    }
    return arrival_of(frame, d2, std::numeric_limits<double>::quiet_NaN());
}

Dbm Medium::level(const Arrival& arrival, NodeId to) const {
    // Distance and pair decide the level: it is the link's, whichever frame it is of.
    const Vec3 there{std::sqrt(arrival.squared_distance), 0, 0};
    const Db lost{computed_loss(arrival.from, to, {}, there, arrival.begin, 0,
                                Db{std::numeric_limits<double>::infinity()})};
    return received_power(kinds_.radio(kind(arrival.from)), kinds_.radio(kind(to)), lost);
}

bool Medium::is_stronger(Arrival& frame, Arrival& other, Db by, NodeId to) {
    const Kind sender = kind(frame.from);
    const bool open = std::isnan(frame.level_dbm) && std::isnan(other.level_dbm);
    if (open && kind(other.from) == sender && kinds_.decision(sender) == Decision::by_range) {
        const auto mine = kinds_.loss_bounds(sender, frame.squared_distance);
        const auto theirs = kinds_.loss_bounds(sender, other.squared_distance);
        if (theirs.low >= mine.high + by.value) return true;
        if (theirs.high < mine.low + by.value) return false;
    }
    for (Arrival* each : {&frame, &other}) {
        if (std::isnan(each->level_dbm)) each->level_dbm = level(*each, to).value;
    }
    return frame.level_dbm >= other.level_dbm + by.value;
}

Duration Medium::delay(double distance) const {
    return settings_.propagation_delay ? flight_time(distance) : Duration{0};
}

void Medium::find_receivers(NodeId from, Time start, Time end, const Legs& legs, Receivers& out) {
    find(from, Strength::decodable, start, legs, frame_key(from, start));
    tell_arrivals(end, out);
}

std::span<const Medium::Found> Medium::find_sensors(NodeId from, Time start, Time end,
                                                    const Legs& legs, Receivers& out) {
    find(from, Strength::detectable, start, legs, frame_key(from, start));
    tell_arrivals(end, out);
    return sensors_.kept();
}

/// Tells when a frame that ends at `end` ends at those found.
void Medium::tell_arrivals(Time end, Receivers& out) const {
    const std::span<const Found> found = found_.kept();
    out.sieved.clear();
    double nearest2 = std::numeric_limits<double>::infinity(), farthest2 = 0;
    Reception* const receptions = out.sieved.room(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double d2 = found[i].squared_distance;
        Reception& reception = receptions[i];
        reception.node = found[i].node;
        reception.time = end + delay(std::sqrt(d2));
        reception.fate = Fate::waiting;
        reception.delivered = false;
        nearest2 = std::min(d2, nearest2);  // in this order it takes one instruction
        farthest2 = std::max(d2, farthest2);
    }
    out.sieved.keep_to(receptions + found.size());
    if (found.empty()) return;
    out.first = end + delay(std::sqrt(nearest2));
    out.last = end + delay(std::sqrt(farthest2));
}

double Medium::heard_within() {
    double squared = 0;
    for (const Found& f : found_.kept()) squared = std::max(squared, f.squared_distance);
    return std::sqrt(squared);
}

bool Medium::hears(NodeId from, NodeId to, Time t, const Legs& legs) {
    if (from == to || !is_on(to) || !may_link(from, to)) return false;
    const Kind mine = kind(from), theirs = kind(to);
    Vec3 here = index_.position_of(from, t, legs), there = index_.position_of(to, t, legs);
    here.z += kinds_.height(mine);
    there.z += kinds_.height(theirs);
    const double d2 = squared_distance(here, there);
    measure(measured_, keys_.size(), legs);  // the reach depends on it
    if (d2 > kinds_.squared_reach(mine, Strength::decodable)) return false;
    kinds_.prepare(mine);
    switch (kinds_.decision(mine)) {
        case Decision::by_range:
            return d2 <= kinds_.squared_range(mine, theirs, Strength::decodable);
        case Decision::by_table:
            return kinds_.table(mine, theirs, Strength::decodable)
                .in_range(d2, draws_.bits(key(from), key(to)));
        case Decision::by_loss: break;
    }
    const Db budget =
        link_budget(kinds_.radio(mine), kinds_.radio(theirs), gain(from, to, t, legs));
    return loss(from, to, here, there, t, 0, budget) <= budget.value;
}

std::uint32_t Medium::reachable(NodeId from, Time t, const Legs& legs) {
    std::vector<bool> seen(keys_.size());
    std::vector<NodeId> frontier{from};
    seen[from.index()] = true;
    const std::size_t all = keys_.size() - off_ + (is_on(from) ? 0 : 1);
    for (std::size_t next = 0; next < frontier.size() && frontier.size() < all; ++next) {
        find(frontier[next], Strength::decodable, t, legs, 0);
        for (const auto [node, squared_distance] : found_.kept()) {
            if (seen[node.index()]) continue;
            seen[node.index()] = true;
            frontier.push_back(node);
        }
    }
    return static_cast<std::uint32_t>(frontier.size() - 1);
}

}  // namespace rovernet
