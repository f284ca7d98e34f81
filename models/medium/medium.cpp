// SPDX-License-Identifier: MIT
#include "models/medium/medium.hpp"

#include "models/propagation/shadowed_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

std::shared_ptr<const Fades> fades_of(const MediumSettings& settings) {
    if (settings.fading.model == FadingModel::none) return nullptr;
    return std::make_shared<Fades>(settings.fading, settings.seed, settings.replication);
}

/// Whether the node rests until its leg is replaced.
bool rests(const Leg& leg, Time t) { return leg.velocity == Vec3{} && t < leg.end; }

}  // namespace

Medium::Medium(const Settings& settings) : Medium(settings, fades_of(settings)) {}

Medium::Medium(const Settings& settings, const std::shared_ptr<const Fades>& fades)
    : settings_(settings),
      draws_(shadowing_draws(settings.seed, settings.replication)),
      stations_(settings_, fades ? std::optional(fades->most()) : std::nullopt),
      links_(settings_, stations_, fades),
      arrivals_(settings_, stations_, links_) {}

void Medium::add(const Radio& radio, std::uint64_t key, const Propagation& propagation) {
    propagation.check_scene(*settings_.scene);
    index_.add(stations_.add(radio, key, propagation));
    ++changes_;
    cells_chosen_ = false;
}

/// Sets the cell size of the index to the reach of the median station: most queries then visit nine
/// cells.
void Medium::choose_cells() {
    std::vector<std::pair<double, std::size_t>> reaches;
    for (Kind k = 0; k < stations_.kinds().size(); ++k) {
        const double reach2 = stations_.kinds().squared_reach(k, Strength::decodable);
        reaches.emplace_back(std::sqrt(reach2), stations_.kinds().stations(k));
    }
    std::sort(reaches.begin(), reaches.end());
    std::size_t seen = 0, median = 0;
    while (2 * (seen += reaches[median].second) < stations_.size()) ++median;
    constexpr double widest = 1e9;  // [m] of models without a bound
    const double size = settings_.all_pairs ? widest : 1.1 * reaches[median].first;
    index_.set_cell_size(std::min(size, widest));
    cells_chosen_ = true;
}

/// Prepares the index for queries about `from` at `t`.
void Medium::look_from(NodeId from, Time t, const Legs& legs) {
    if (!cells_chosen_) {
        choose_cells();
    }
    index_.refresh(t, legs);
    origin_ = antenna(from, stations_.kind(from), t, legs);
}

/// Visitor for the index: calls use(entry, antenna, squared distance and, if the index returns it,
/// place) for nodes within reach that are on and may have a link.
template <class Use>
auto Medium::within(NodeId from, Kind mine, double reach2, Use use) const {
    return [=, this](const Entry& e, Vec3 p, auto... place) {
        p.z += stations_.kinds().height(e.label);
        const double d2 = squared_distance(origin_, p);
        if (d2 > reach2 || e.node == from || !stations_.is_on(e.node)) return;
        if (!stations_.kinds().may_link(mine, e.label)) return;
        use(e, p, d2, place...);
    };
}

template <class Use>
void Medium::visit(NodeId from, Kind mine, double reach2, Time t, const Legs& legs, Use use) {
    look_from(from, t, legs);
    index_.visit(origin_, std::sqrt(std::max(reach2, 0.0)), t, legs,
                 within(from, mine, reach2, use));
}

/// Finds the nodes at which a signal of `from` is strong enough: nodes that can decode it go into
/// found_, the others into sensors_.
void Medium::find(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs,
                  std::uint64_t frame) {
    const std::tuple search{from, mine, strength, t, changes_};
    // Repeated search: Sent::reachable has just found the same nodes. Only frames that fade differ.
    if (std::exchange(last_, search) == search && !links_.fades()) return;
    found_.clear();
    sensors_.clear();
    stations_.measure(legs);  // decision and reach depend on it
    stations_.kinds().prepare(mine);
    switch (stations_.kinds().decision(mine)) {
        case Decision::by_range:
            return stations_.kinds().size() == 1 && strength == Strength::decodable
                       ? find_alike(from, mine, t, legs)
                       : find_in_range(from, mine, strength, t, legs);
        case Decision::by_table: return find_in_table(from, mine, strength, t, legs);
        case Decision::by_loss: return find_in_reach(from, mine, strength, t, legs, frame);
    }
}

void Medium::find_in_range(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs) {
    const auto in_range = [&](const Entry& e, Strength s, double d2) {
        return d2 <= stations_.kinds().squared_range(mine, e.label, s);
    };
    visit(from, mine, stations_.kinds().squared_reach(mine, strength), t, legs,
          [&](const Entry& e, Vec3, double d2) {
              const bool decodes = in_range(e, Strength::decodable, d2);
              if (!decodes && !in_range(e, strength, d2)) return;
              (decodes ? found_ : sensors_).put({e.node, d2}, true);
          });
}

/// Search as find_in_range(), for stations of one kind and therefore one network, and for nodes
/// that can decode.
void Medium::find_alike(NodeId from, Kind mine, Time t, const Legs& legs) {
    look_from(from, t, legs);
    const double range2 = stations_.kinds().squared_range(mine, mine, Strength::decodable);
    const auto places = index_.near(origin_, std::sqrt(std::max(range2, 0.0)), t);
    Found* next = found_.room(places.size() + index_.apart());
    // Copies, which the compiler knows to be constant in the loop.
    const auto visit = [&next, from, range2, origin = origin_,
                        height = stations_.kinds().height(mine),
                        switches = Stations::Switches(stations_)](const Entry& e, Vec3 p) {
        p.z += height;
        const double d2 = squared_distance(origin, p);
        const bool on = switches.is_on(e.node);
        *next = {e.node, d2};
        next += (d2 <= range2) & (e.node != from) & on;
    };
    index_.visit(places, t, legs, visit);
    found_.keep_to(next);
}

void Medium::find_in_table(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs) {
    look_from(from, t, legs);
    const std::uint64_t share = draws_.share(stations_.key(from));
    const auto use = [&](const Entry& e, Vec3, double d2, std::uint32_t place) {
        const std::uint64_t theirs =
            place == NeighbourIndex::nowhere ? draws_.share(stations_.key(e.node)) : shares_[place];
        const std::uint64_t bits = PairDraws::bits_of_shares(share, theirs);
        const auto in_range = [&](Strength s) {
            return stations_.kinds().table(mine, e.label, s).in_range(d2, bits);
        };
        if (!in_range(strength)) return;
        // A node that can decode a frame also senses it.
        const bool decodes = strength == Strength::decodable || in_range(Strength::decodable);
        (decodes ? found_ : sensors_).put({e.node, d2}, true);
    };
    // The draws exclude most nodes before any other check.
    if (std::exchange(shares_of_bin_, index_.bins()) != index_.bins()) share_draws();
    const FirstLook& look = stations_.kinds().first_look(mine, strength);
    const auto passes = [share, &look, shares = shares_.data()](std::uint32_t place,
                                                                float at_least) {
        return look.passes(at_least, PairDraws::bits_of_shares(share, shares[place]));
    };
    const double reach2 = stations_.kinds().squared_reach(mine, strength);
    index_.visit_if(origin_, std::sqrt(reach2), t, legs, passes, within(from, mine, reach2, use));
}

/// Fills shares_.
void Medium::share_draws() {
    shares_.clear();
    for (const Entry& e : index_.entries()) shares_.push_back(draws_.share(stations_.key(e.node)));
}

void Medium::find_in_reach(NodeId from, Kind mine, Strength strength, Time t, const Legs& legs,
                           std::uint64_t frame) {
    const Scene& scene = settings_.scene_at(t);
    if (std::exchange(pairs_of_, &scene) != &scene) pairs_.forget_all();
    const bool fixed = settings_.keep_losses && !settings_.all_pairs && rests(legs.leg(from), t);
    candidates_.clear();
    visit(from, mine, stations_.kinds().squared_reach(mine, strength), t, legs,
          [&](const Entry& e, Vec3 p, double d2) {
              const Db budget = stations_.kinds().budget(strength, mine, e.label,
                                                         stations_.gain(from, e.node, t, legs));
              candidates_.add({.node = e.node,
                               .rests = fixed && !e.moves,
                               .key = stations_.key(e.node),
                               .antenna = p,
                               .squared_distance = d2,
                               .budget_db = budget.value});
          });
    const Db told =
        candidates_.compute_losses(stations_.model(from), links_.batch(from, origin_, t, frame),
                                   from, pairs_, links_.most_fade());
    const bool keeps = links_.keeps(stations_.model(from).shape());
    for (const Candidate& c : candidates_.all()) {
        if (keeps) links_.keep({from, c.node, origin_, c.antenna, &scene}, told, c.loss_db);
        const double loss_db = links_.faded(c.loss_db, from, c.node, origin_, c.antenna, frame);
        if (loss_db > c.budget_db) continue;
        const auto budget = [&] {
            return stations_.kinds().budget(Strength::decodable, mine, stations_.kind(c.node),
                                            stations_.gain(from, c.node, t, legs));
        };
        const bool decodes = strength == Strength::decodable || loss_db <= budget().value;
        (decodes ? found_ : sensors_).put({c.node, c.squared_distance}, true);
    }
}

void Medium::find_receivers(NodeId from, Coding coding, Time start, Time end, const Legs& legs,
                            Receivers& out) {
    find(from, stations_.kind(from, coding), Strength::decodable, start, legs,
         links_.frame_key(from, start));
    put_arrivals(end, out);
}

std::span<const Medium::Found> Medium::find_sensors(NodeId from, Coding coding, Time start,
                                                    Time end, const Legs& legs, Receivers& out) {
    find(from, stations_.kind(from, coding), Strength::detectable, start, legs,
         links_.frame_key(from, start));
    put_arrivals(end, out);
    return sensors_.kept();
}

/// Puts the nodes found into `out`, with the end of a frame there that ends at `end` at its sender.
void Medium::put_arrivals(Time end, Receivers& out) const {
    const std::span<const Found> found = found_.kept();
    out.sieved.clear();
    double nearest2 = std::numeric_limits<double>::infinity(), farthest2 = 0;
    Reception* const receptions = out.sieved.room(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double d2 = found[i].squared_distance;
        Reception& reception = receptions[i];
        reception.node = found[i].node;
        reception.time = end + arrivals_.delay(std::sqrt(d2));
        reception.fate = Fate::waiting;
        reception.delivered = false;
        nearest2 = std::min(d2, nearest2);  // in this order it takes one instruction
        farthest2 = std::max(d2, farthest2);
    }
    out.sieved.keep_to(receptions + found.size());
    out.origin = origin_;
    out.heard_within = std::sqrt(farthest2);
    if (found.empty()) return;
    out.first = end + arrivals_.delay(std::sqrt(nearest2));
    out.last = end + arrivals_.delay(out.heard_within);
}

void Medium::find_receiver(NodeId from, NodeId to, Coding coding, Time start, Time end,
                           const Legs& legs, Receivers& out) {
    const Kind mine = stations_.kind(from, coding);
    last_.reset();
    found_.clear();
    origin_ = antenna(from, mine, start, legs);
    const auto found = link(from, mine, origin_, to, start, legs, links_.frame_key(from, start));
    if (found) found_.put(*found, true);
    put_arrivals(end, out);
}

bool Medium::hears(NodeId from, NodeId to, Time t, const Legs& legs) {
    const Kind mine = stations_.kind(from);
    return link(from, mine, antenna(from, mine, t, legs), to, t, legs, 0).has_value();
}

Vec3 Medium::antenna(NodeId node, Kind kind, Time t, const Legs& legs) const {
    Vec3 place = index_.position_of(node, t, legs);
    place.z += stations_.kinds().height(kind);
    return place;
}

std::optional<Medium::Found> Medium::link(NodeId from, Kind mine, Vec3 here, NodeId to, Time t,
                                          const Legs& legs, std::uint64_t frame) {
    if (from == to || !stations_.is_on(to) || !stations_.may_link(from, to)) return {};
    const Kind theirs = stations_.kind(to);
    const Vec3 there = antenna(to, theirs, t, legs);
    const double d2 = squared_distance(here, there);
    stations_.measure(legs);  // decision and reach depend on it
    if (d2 > stations_.kinds().squared_reach(mine, Strength::decodable)) return {};
    stations_.kinds().prepare(mine);
    const auto is_strong_enough = [&] {
        switch (stations_.kinds().decision(mine)) {
            case Decision::by_range:
                return d2 <= stations_.kinds().squared_range(mine, theirs, Strength::decodable);
            case Decision::by_table:
                return stations_.kinds()
                    .table(mine, theirs, Strength::decodable)
                    .in_range(d2, draws_.bits(stations_.key(from), stations_.key(to)));
            case Decision::by_loss: break;
        }
        const Db budget = stations_.kinds().budget(Strength::decodable, mine, theirs,
                                                   stations_.gain(from, to, t, legs));
        return links_.of_frame(from, to, here, there, t, frame, budget) <= budget.value;
    };
    return is_strong_enough() ? std::optional<Found>{{to, d2}} : std::nullopt;
}

}  // namespace rovernet
