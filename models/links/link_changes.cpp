// SPDX-License-Identifier: MIT
#include "models/links/link_changes.hpp"

#include "models/link_gain.hpp"
#include "models/links/range_crossing.hpp"
#include "models/medium/medium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace rovernet {
namespace {

using namespace std::chrono_literals;

constexpr Duration instant = 1ns;

/// Interval between two states: the link has one state at `before` and the other at `after`.
struct Bracket {
    Time before;
    Time after;
};

/// Time `s` seconds after `begin`, limited to begin ... end.
Time time_within(Time begin, double s, Time end) {
    if (!(s > 0)) return begin;
    if (s >= seconds(end - begin)) return end;
    return std::min(end, begin + Duration{std::llround(s * 1e9)});
}

/// Time interval in which both ends move straight, and their motions; t = 0 is its start.
struct Piece {
    Time begin;
    Time end;
    StraightMotion a = {}, b = {};

    Vec3 apart() const { return b.from - a.from; }
    Vec3 speed() const { return b.velocity - a.velocity; }
    Time at(double s) const { return time_within(begin, s, end); }
    Time closest_approach() const {
        const double speed2 = dot(speed(), speed());
        return speed2 > 0 ? at(-dot(apart(), speed()) / speed2) : begin;
    }
    Piece part(Time first, Time last) const {
        const double s = seconds(first - begin);
        return {first, last, {a.at(s), a.velocity}, {b.at(s), b.velocity}};
    }
};

/// Search for the next change of one link.
class Search {
  public:
    Search(const Medium& medium, const Legs& legs, const WallPassages& walls, NodeId from,
           NodeId to, const LinkSearch& settings, std::int64_t most_looks)
        : medium_(medium),
          legs_(legs),
          walls_(walls),
          from_(from),
          to_(to),
          settings_(settings),
          most_looks_(most_looks),
          reach_(medium.stations()
                     .model(from)
                     .reach(medium.stations().kinds().budget(Strength::decodable,
                                                             medium.stations().kind(from),
                                                             medium.stations().kind(to)),
                            medium.stations().radio(from).frequency)
                     .value) {}

    LinkOutlook outlook(Time after, Time until);

  private:
    bool is_up(Time t) const { return medium_.links().is_up(from_, to_, t, legs_); }
    double margin(Time t) const { return medium_.links().margin(from_, to_, t, legs_).value; }
    bool changed(double some_margin) const { return (some_margin >= 0) != up_; }
    bool out_of_reach(Time t) const;
    StraightMotion motion(NodeId node, Time t) const;
    Piece piece(Time begin, Time end) const;
    LossShape shape(const Piece& piece) const;

    std::optional<Time> change_in(const Piece& all);
    std::optional<Piece> in_reach(const Piece& all) const;
    std::optional<Bracket> by_distance(const Piece& piece) const;
    Bracket about(Bracket bracket, const Piece& piece) const;
    std::optional<Bracket> by_walls(const Piece& piece) const;
    std::optional<Bracket> by_samples(const Piece& piece);
    struct Look {
        Time time;
        double margin;  // [dB]
    };
    std::optional<Bracket> between_passages(Look first, Time last) const;
    std::optional<Bracket> smooth_change(Look p, Look q, Duration least) const;
    Time bisect(Bracket bracket) const;

    const Medium& medium_;
    const Legs& legs_;
    const WallPassages& walls_;
    const NodeId from_;
    const NodeId to_;
    const LinkSearch& settings_;
    const std::int64_t most_looks_;
    const double reach_;                  // [m] beyond it the link is down
    bool up_ = false;                     // at the begin of the search
    bool exact_ = false;                  // a change can be found to the nanosecond
    std::optional<Time> last_look_ = {};  // of a search that has had all its looks
};

/// Factor slightly above 1 on the model's reach, for rounding.
constexpr double slack = 1 + 1e-9;

bool Search::out_of_reach(Time t) const {
    return distance(medium_.stations().antenna(from_, t, legs_),
                    medium_.stations().antenna(to_, t, legs_)) > reach_ * slack;
}

StraightMotion Search::motion(NodeId node, Time t) const {
    const Leg& leg = legs_.leg(node);
    return {medium_.stations().antenna(node, t, legs_), t < leg.end ? leg.velocity : Vec3{}};
}

/// The two ends in a fixed order, so that the opposite link changes at the same times.
Piece Search::piece(Time begin, Time end) const {
    const auto values = [](const StraightMotion& m) {
        return std::tie(m.from.x, m.from.y, m.from.z, m.velocity.x, m.velocity.y, m.velocity.z);
    };
    Piece piece{begin, end, motion(from_, begin), motion(to_, begin)};
    if (values(piece.b) < values(piece.a)) std::swap(piece.a, piece.b);
    return piece;
}

/// Shape: by_distance, by_walls or unknown, because there is only one pair.
LossShape Search::shape(const Piece& piece) const {
    const LossShape shape = medium_.links().shape(from_, to_, piece.begin, legs_);
    const bool clear = shape == LossShape::by_walls && walls_.empty();
    return clear || shape == LossShape::by_pair ? LossShape::by_distance : shape;
}

LinkOutlook Search::outlook(Time after, Time until) {
    up_ = is_up(after);
    std::array<Time, 3> ends{std::min(legs_.leg(from_).end, until),
                             std::min(legs_.leg(to_).end, until), until};
    std::sort(ends.begin(), ends.end());
    for (const Time end : ends) {
        if (end <= after) continue;
        if (const auto change = change_in(piece(after, end))) return {change, *change};
        if (last_look_) return {std::nullopt, *last_look_};
        after = end;
    }
    return {std::nullopt, until};
}

std::optional<Time> Search::change_in(const Piece& all) {
    if (!medium_.links().may_change(from_, to_, all.begin, legs_)) return std::nullopt;
    std::optional<Bracket> found;
    Time looked = all.begin;
    if (const auto piece = in_reach(all)) {
        looked = piece->end;
        const LossShape here = shape(*piece);
        exact_ = here == LossShape::by_distance;
        if (exact_) {
            found = by_distance(*piece);
        } else {
            found = here == LossShape::by_walls ? by_walls(*piece) : by_samples(*piece);
        }
    }
    if (last_look_) return std::nullopt;
    if (!found && looked < all.end && (up_ || !out_of_reach(all.end)) && is_up(all.end) != up_)
        found = Bracket{looked, all.end};
    if (!found) return std::nullopt;
    return bisect(*found);
}

/// Part of a piece within reach, outside which the link is down; empty if there is none.
std::optional<Piece> Search::in_reach(const Piece& all) const {
    if (up_ || !std::isfinite(reach_)) return all;
    if (all.speed() == Vec3{}) {
        if (out_of_reach(all.begin)) return std::nullopt;
        return all;
    }
    const auto passage = range_crossing(all.apart(), all.speed(), reach_ * slack);
    if (!passage || passage->leave <= 0 || passage->enter >= seconds(all.end - all.begin))
        return std::nullopt;
    const Time enter = all.at(passage->enter), leave = all.at(passage->leave);
    const Time first = enter > all.begin ? enter - instant : enter;
    const Time last = leave < all.end ? leave + instant : leave;
    return all.part(first, last);
}

std::optional<Bracket> Search::by_distance(const Piece& piece) const {
    Time before = piece.begin;
    for (const Time t : {piece.closest_approach(), piece.end}) {
        if (t <= before) continue;
        if (is_up(t) != up_) return about({before, t}, piece);
        before = t;
    }
    return std::nullopt;
}

/// Bracket narrowed around the time at which the model's reach ends.
Bracket Search::about(Bracket bracket, const Piece& piece) const {
    const auto passage = range_crossing(piece.apart(), piece.speed(), reach_);
    if (!passage) return bracket;
    const Time guess = piece.at(up_ ? passage->leave : passage->enter);
    for (const Duration off : {-2 * instant, 2 * instant}) {
        const Time t = guess + off;
        if (t <= bracket.before || t >= bracket.after) continue;
        (is_up(t) == up_ ? bracket.before : bracket.after) = t;
    }
    return bracket;
}

std::optional<Bracket> Search::by_samples(const Piece& piece) {
    constexpr std::int64_t looks_per_step = 65536;
    Time before = piece.begin;
    Duration step = settings_.min_dwell;
    for (std::int64_t looks = 1; before < piece.end; ++looks) {
        const Time t = piece.end - before > step ? before + step : piece.end;
        if (is_up(t) != up_) return Bracket{before, t};
        before = t;
        if (looks == most_looks_ && before < piece.end) {
            last_look_ = before;
            return std::nullopt;
        }
        if (looks % looks_per_step == 0 && step < Duration::max() / 2) step *= 2;
    }
    return std::nullopt;
}

std::optional<Bracket> Search::by_walls(const Piece& piece) const {
    std::vector<double> passages;
    walls_.times(piece.a, piece.b, seconds(piece.end - piece.begin), passages);
    std::vector<Time> cuts{piece.begin, piece.closest_approach(), piece.end};
    for (const double s : passages) cuts.push_back(piece.at(s));
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());

    Time before = piece.begin;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        // Exactly at a corner a line of sight may be as before it, as after it, or neither.
        const Time first = cuts[i] + instant, last = cuts[i + 1] - instant;
        if (first > last) continue;
        const Look begin{first, margin(first)};
        if (changed(begin.margin)) return Bracket{before, first};
        if (const auto found = between_passages(begin, last)) return found;
        before = last;
    }
    if (changed(margin(piece.end))) return Bracket{before, piece.end};
    return std::nullopt;
}

/// Change in an interval in which the loss is smooth, and at whose start there is none.
std::optional<Bracket> Search::between_passages(Look first, Time last) const {
    constexpr int most_halvings = 20;
    if (first.time == last) return std::nullopt;
    const Duration least = (last - first.time) / (1 << most_halvings);
    return smooth_change(first, {last, margin(last)}, std::max(settings_.tolerance, least));
}

std::optional<Bracket> Search::smooth_change(Look p, Look q, Duration least) const {
    constexpr double safety = 2;
    constexpr double rounding = 1e-11;  // [dB] of a loss
    const Duration length = q.time - p.time;
    const Time middle = p.time + length / 2;
    const bool ends_changed = changed(q.margin);
    if (length <= least || middle == p.time)
        return ends_changed ? std::optional<Bracket>({p.time, q.time}) : std::nullopt;
    const Look m{middle, margin(middle)};
    if (changed(m.margin)) return Bracket{p.time, m.time};
    // Between the three samples a parabola through them exceeds the nearest by at most bend / 8.
    const double bend = std::abs(p.margin - 2 * m.margin + q.margin);
    const double clear = std::min({std::abs(p.margin), std::abs(m.margin), std::abs(q.margin)});
    if (clear >= safety * (bend - rounding))
        return ends_changed ? std::optional<Bracket>({m.time, q.time}) : std::nullopt;
    if (const auto found = smooth_change(p, m, least)) return found;
    return smooth_change(m, q, least);
}

/// First time of the new state, for one change in the bracket.
Time Search::bisect(Bracket bracket) const {
    const Duration tolerance = exact_ ? instant : settings_.tolerance;
    while (bracket.after - bracket.before > tolerance) {
        const Time middle = bracket.before + (bracket.after - bracket.before) / 2;
        (is_up(middle) == up_ ? bracket.before : bracket.after) = middle;
    }
    return bracket.after;
}

}  // namespace

LinkOutlook look_ahead(const Medium& medium, const Legs& legs, const WallPassages& walls,
                       NodeId from, NodeId to, Time after, Time until, const LinkSearch& search,
                       std::int64_t most_looks) {
    if (search.tolerance < instant || search.min_dwell < instant)
        throw std::invalid_argument("LinkSearch: tolerance and min_dwell must be at least 1 ns");
    if (until == never) until -= instant;  // at `never` itself a leg without end has ended
    if (from == to || until <= after || !medium.stations().is_on(from) ||
        !medium.stations().is_on(to) || !medium.stations().may_link(from, to))
        return {std::nullopt, until};
    return Search(medium, legs, walls, from, to, search, most_looks).outlook(after, until);
}

std::optional<Time> next_link_change(const Medium& medium, const Legs& legs,
                                     const WallPassages& walls, NodeId from, NodeId to, Time after,
                                     Time until, const LinkSearch& search) {
    constexpr std::int64_t all = std::numeric_limits<std::int64_t>::max();
    return look_ahead(medium, legs, walls, from, to, after, until, search, all).change;
}

std::optional<Time> next_link_change(const Medium& medium, const Legs& legs, const Scene& scene,
                                     NodeId from, NodeId to, Time after, Time until,
                                     const LinkSearch& search) {
    const bool by_walls = medium.stations().model(from).shape() == LossShape::by_walls;
    return next_link_change(medium, legs, by_walls ? WallPassages(scene) : WallPassages(), from, to,
                            after, until, search);
}

}  // namespace rovernet
