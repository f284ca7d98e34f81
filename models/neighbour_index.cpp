// SPDX-License-Identifier: MIT
#include "models/neighbour_index.hpp"

#include <limits>

namespace rovernet {
namespace {

double speed(const Leg& leg) { return std::sqrt(dot(leg.velocity, leg.velocity)); }

/// The extent of a set of coordinates.
struct Extent {
    double low = 0, high = 0;
    void take(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// Share of the nodes that may be kept apart, and a few always.
std::size_t few(std::size_t nodes) { return nodes / 64 + 16; }

}  // namespace

void NeighbourIndex::moved(NodeId node, const Legs& legs) {
    if (stale_) return;
    const Leg& leg = legs.leg(node);
    const Entry now = entry(node, labels_[node.index()], leg);
    const std::uint32_t place = place_[node.index()];
    if (place & is_apart) {
        apart_[place & ~is_apart] = now;
        return;
    }
    const Entry& before = entries_[place];
    const Vec3 was = leg.start >= before.end
                         ? before.from + seconds(before.end - before.start) * before.velocity
                         : before.from + seconds(leg.start - before.start) * before.velocity;
    const double jump = distance(was, leg.from);
    if (speed(leg) > top_speed_ || jump > 1e-3 * cell_) return keep_apart(now);
    jumped_ += jump;
    entries_[place] = now;
}

std::span<const std::uint32_t> NeighbourIndex::near(Vec3 centre, double reach) {
    near_.clear();
    const auto cells_x = cells(centre.x, reach, columns_);
    const auto cells_y = cells(centre.y, reach, rows_);
    // Wide enough for what single precision leaves of coordinates.
    const double wide = reach + 1e-6 * (std::abs(centre.x) + std::abs(centre.y) + reach);
    const auto reach2 = static_cast<float>(wide * wide);
    const auto x = static_cast<float>(centre.x), y = static_cast<float>(centre.y);
    for_each_wrapped(cells_y, rows_, [&](std::size_t bottom, std::size_t top) {
        for (std::size_t row = bottom; row < top; ++row) {
            for_each_wrapped(cells_x, columns_, [&](std::size_t left, std::size_t right) {
                look_through(first_[row * columns_ + left], first_[row * columns_ + right], x, y,
                             reach2);
            });
        }
    });
    return near_;
}

/// Appends those near to near_, without a branch that would be mispredicted.
void NeighbourIndex::look_through(std::uint32_t begin, std::uint32_t end, float x, float y,
                                  float reach2) {
    looked_at_ += end - begin + 1;
    std::size_t found = near_.size();
    near_.resize(found + (end - begin));
    for (std::uint32_t i = begin; i < end; ++i) {
        const float dx = x_[i] - x, dy = y_[i] - y;
        near_[found] = i;
        found += dx * dx + dy * dy <= reach2;
    }
    near_.resize(found);
}

/// Moves a node out of its cell, where an entry that is nowhere remains.
void NeighbourIndex::keep_apart(const Entry& e) {
    std::uint32_t& place = place_[e.node.index()];
    x_[place] = std::numeric_limits<float>::quiet_NaN();
    place = is_apart | static_cast<std::uint32_t>(apart_.size());
    apart_.push_back(e);
}

/// The speed [m/s] above which a node is kept apart: that of the fastest, unless only a few are
/// more than four times as fast as all others.
double NeighbourIndex::choose_top_speed(const Legs& legs) const {
    std::vector<double> speeds;
    speeds.reserve(legs.size());
    for (std::uint32_t i = 0; i < legs.size(); ++i) speeds.push_back(speed(legs.leg(NodeId{i})));
    if (speeds.empty()) return 0;
    const double fastest = *std::max_element(speeds.begin(), speeds.end());
    const std::size_t some = few(speeds.size()) / 2;
    if (some >= speeds.size()) return fastest;
    const auto others = speeds.end() - 1 - static_cast<std::ptrdiff_t>(some);
    std::nth_element(speeds.begin(), others, speeds.end());
    return fastest > 4 * *others ? *others : fastest;
}

/// At most two cells a node: columns and rows as the nodes need them, or fewer, which wrap around.
void NeighbourIndex::lay_grid(Time t, const Legs& legs) {
    Extent x, y;
    for (std::uint32_t i = 0; i < legs.size(); ++i) {
        const Vec3 p = legs.position(NodeId{i}, t);
        if (i == 0) x = {p.x, p.x}, y = {p.y, p.y};
        x.take(p.x);
        y.take(p.y);
    }
    const double most = 2.0 * static_cast<double>(legs.size()) + 1;
    cell_ = std::max(wanted_cell_, 1e-3);
    const auto needed = [&](Extent e) { return std::floor((e.high - e.low) / cell_) + 2; };
    const double rows = std::min(needed(y), std::floor(std::sqrt(most)) + 1);
    const double columns = std::min(needed(x), std::floor(most / rows) + 1);
    rows_ = static_cast<std::size_t>(std::min(needed(y), std::floor(most / columns) + 1));
    columns_ = static_cast<std::size_t>(columns);
}

/// Sorts all nodes into cells by counting.
void NeighbourIndex::bin(Time t, const Legs& legs) {
    lay_grid(t, legs);
    top_speed_ = choose_top_speed(legs);
    binned_ = t;
    jumped_ = 0;
    looked_at_ = 0;
    apart_.clear();
    place_.resize(legs.size());
    first_.assign(columns_ * rows_ + 1, 0);
    const auto is_slow = [&](const Leg& leg) { return speed(leg) <= top_speed_; };
    std::vector<std::uint32_t> cell(legs.size());
    for (std::uint32_t i = 0; i < legs.size(); ++i) {
        if (!is_slow(legs.leg(NodeId{i}))) continue;
        cell[i] = static_cast<std::uint32_t>(cell_at(legs.position(NodeId{i}, t)));
        ++first_[cell[i]];
    }
    std::uint32_t end = 0;
    for (auto& first : first_) first = end += first;
    entries_.resize(end);
    x_.resize(end);
    y_.resize(end);
    for (auto i = static_cast<std::uint32_t>(legs.size()); i-- > 0;) {
        const Leg& leg = legs.leg(NodeId{i});
        const Entry e = entry(NodeId{i}, labels_[i], leg);
        if (!is_slow(leg)) {
            place_[i] = is_apart | static_cast<std::uint32_t>(apart_.size());
            apart_.push_back(e);
        } else {
            place_[i] = --first_[cell[i]];
            entries_[place_[i]] = e;
            const Vec3 p = leg.position(t);
            x_[place_[i]] = static_cast<float>(p.x);
            y_[place_[i]] = static_cast<float>(p.y);
        }
    }
    allowed_apart_ = apart_.size() + few(legs.size());
    stale_ = false;
}

}  // namespace rovernet
