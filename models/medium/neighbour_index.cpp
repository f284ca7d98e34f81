// SPDX-License-Identifier: MIT
#include "models/medium/neighbour_index.hpp"

#include "models/medium/point_sieve.hpp"

#include <limits>
#include <utility>

namespace rovernet {
namespace {

double length(Vec3 v) { return std::sqrt(dot(v, v)); }

/// Range of a set of coordinates.
struct Extent {
    double low = 0, high = 0;
    void take(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

constexpr double far = 1e30;  // [m] from everything, and a number in single precision

/// Number of nodes that may be stored separately: a fraction, and always a few.
std::size_t few(std::size_t nodes) { return nodes / 64 + 16; }

/// Speed [m/s] above which a node is stored separately: that of the fastest node, unless only a few
/// nodes are more than four times as fast as all others.
double choose_top_speed(std::vector<double> speeds) {
    if (speeds.empty()) return 0;
    const double fastest = *std::max_element(speeds.begin(), speeds.end());
    const std::size_t some = few(speeds.size()) / 2;
    if (some >= speeds.size()) return fastest;
    const auto others = speeds.end() - 1 - static_cast<std::ptrdiff_t>(some);
    std::nth_element(speeds.begin(), others, speeds.end());
    return fastest > 4 * *others ? *others : fastest;
}

}  // namespace

void NeighbourIndex::add(std::uint32_t label) {
    place_.push_back(0);
    if (label != 0 || !labels_.empty()) {
        labels_.reserve(place_.capacity());
        labels_.resize(place_.size());
        labels_.back() = label;
    }
    stale_ = true;
}

void NeighbourIndex::moved(NodeId node, const Legs& legs) {
    if (stale_) return;
    const Leg& leg = legs.leg(node);
    const std::uint32_t place = place_[node.index()];
    if (place & is_apart) return apart_.put(place & ~is_apart, node, label(node), leg);
    Vec3 was = binned_.entries[place].from;
    if (binned_.entries[place].moves) {
        const auto& [velocity, start, end] = binned_.motions[place];
        was = was + seconds(std::min(leg.start, end) - start) * velocity;
    }
    const double jump = distance(was, leg.from);
    if (length(leg.velocity) > drift_.top_speed || jump > 1e-3 * rows_.width())
        return keep_apart(node, leg);
    drift_.jumped += jump;
    binned_.put(place, node, label(node), leg);
}

template <bool distances_too>
std::span<std::uint32_t> NeighbourIndex::look_around(Vec3 centre, double reach) {
    const auto columns = columns_.near(centre.x, reach);
    const auto rows = rows_.near(centre.y, reach);
    const double wide = reach + rounding(centre, reach);
    const PointSieve<distances_too> sieve(x_.data(), y_.data(), static_cast<float>(centre.x),
                                          static_cast<float>(centre.y),
                                          static_cast<float>(wide * wide));
    const std::uint32_t* const cells = first_.data();
    const std::size_t cells_in_row = columns_.cells(), all_rows = rows_.cells();
    std::size_t looked_at = 1, found = 0, room = near_.size();
    std::size_t row = rows.begin;
    for (std::size_t left = rows.count(); left > 0; --left, ++row) {
        if (row == all_rows) row = 0;
        const std::uint32_t* const first = cells + row * cells_in_row;
        std::uint32_t begin = first[columns.begin], end = first[columns.end];
        for (bool wraps = columns.wrapped_end > 0;; wraps = false) {
            looked_at += end - begin;
            const std::size_t most = found + (end - begin) + sieve.at_once;
            if (most > room) [[unlikely]]
                room = make_room(most);
            found += sieve.sift(begin, end, near_.data() + found, distance2_.data() + found);
            if (!wraps) break;
            begin = first[0];
            end = first[columns.wrapped_end];
        }
    }
    looked_at_ += looked_at;
    return {near_.data(), found};
}
template std::span<std::uint32_t> NeighbourIndex::look_around<false>(Vec3, double);
template std::span<std::uint32_t> NeighbourIndex::look_around<true>(Vec3, double);

/// Replaces the first `count` values of distance2_ by lower bounds of the current squared
/// distances, for any motion since the nodes were binned.
float* NeighbourIndex::distances_at_least(std::size_t count, Vec3 centre, double radius, Time t) {
    const double most = (slack(t) + rounding(centre, radius + slack(t))) * (1 + 1e-6);
    const auto off = static_cast<float>(std::min(most, far));
    float* const at_least = distance2_.data();
    for (std::size_t i = 0; i < count; ++i) {
        const float nearer = (1 - 1e-6F) * std::sqrt(at_least[i]) - off;
        const float nearest = (nearer + std::abs(nearer)) / 2;  // or 0
        at_least[i] = (1 - 1e-6F) * nearest * nearest;
    }
    return at_least;
}

/// Allocates memory for the results of look_around(); returns its size.
std::size_t NeighbourIndex::make_room(std::size_t places) {
    near_.resize(2 * places);
    distance2_.resize(2 * places);
    return near_.size();
}

/// Removes a node from its cell, which keeps an unused entry, and stores it separately.
void NeighbourIndex::keep_apart(NodeId node, const Leg& leg) {
    x_[place_[node.index()]] = std::numeric_limits<float>::quiet_NaN();
    apart_.put(add_apart(node), node, label(node), leg);
}

/// Creates the node's entry in apart_; returns its index.
std::size_t NeighbourIndex::add_apart(NodeId node) {
    const std::size_t place = apart_.entries.size();
    place_[node.index()] = is_apart | static_cast<std::uint32_t>(place);
    apart_.entries.emplace_back();
    return place;
}

/// Moves all nodes into one table, in the order of their former cells, so that sorting them again
/// moves few. Nodes of unknown positions are in the order of their addition.
IndexTable NeighbourIndex::take_all(const Legs& legs) {
    IndexTable all = std::exchange(binned_, {});
    if (stale_) {
        all.entries.resize(legs.size());
        for (std::uint32_t i = 0; i < legs.size(); ++i) {
            all.put(i, NodeId{i}, label(NodeId{i}), legs.leg(NodeId{i}));
        }
        return all;
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.entries.size(); ++i) {
        if (!std::isnan(x_[i])) all.put(count++, all.entries[i], all.motion(i));
    }
    all.entries.resize(count + apart_.entries.size());
    for (std::size_t i = 0; i < apart_.entries.size(); ++i) {
        all.put(count++, apart_.entries[i], apart_.motion(i));
    }
    return all;
}

/// Makes a grid of at most two cells per node: with the columns and rows that the nodes need, or
/// fewer, which wrap around.
void NeighbourIndex::lay_grid(const IndexTable& all, Time t, const Legs& legs) {
    Extent x, y;
    for (std::size_t i = 0; i < all.entries.size(); ++i) {
        const Vec3 p = all.position(i, t, legs);
        if (i == 0) x = {p.x, p.x}, y = {p.y, p.y};
        x.take(p.x);
        y.take(p.y);
    }
    const double most = 2.0 * static_cast<double>(legs.size()) + 1;
    constexpr double cells_per_height = 4;
    const double height = std::max(wanted_cell_, 1e-3), width = height / cells_per_height;
    const double needed_rows = std::floor((y.high - y.low) / height) + 2;
    const double needed_columns = std::floor((x.high - x.low) / width) + 2;
    const double rows = std::min(needed_rows, std::floor(std::sqrt(most / cells_per_height)) + 1);
    const double columns = std::min(needed_columns, std::floor(most / rows) + 1);
    rows_ = WrappedAxis(
        height, static_cast<std::size_t>(std::min(needed_rows, std::floor(most / columns) + 1)));
    columns_ = WrappedAxis(width, static_cast<std::size_t>(columns));
}

/// Sorts all nodes into cells by counting.
void NeighbourIndex::bin(Time t, const Legs& legs) {
    const IndexTable all = take_all(legs);
    const auto nodes = static_cast<std::uint32_t>(all.entries.size());
    lay_grid(all, t, legs);
    std::vector<double> speeds(nodes);
    for (std::uint32_t i = 0; i < nodes; ++i) speeds[i] = length(all.motion(i).velocity);
    const double top_speed = choose_top_speed(speeds);
    drift_ = {
        .since = t, .top_speed = top_speed, .top_speed_per_ns = top_speed * (1e-9 * (1 + 1e-12))};
    looked_at_ = 0;
    apart_ = {};
    first_.assign(columns_.cells() * rows_.cells() + 1, 0);
    std::vector<std::uint32_t> cell(nodes);
    for (std::uint32_t i = 0; i < nodes; ++i) {
        if (speeds[i] > top_speed) continue;
        cell[i] = static_cast<std::uint32_t>(cell_at(all.position(i, t, legs)));
        ++first_[cell[i]];
    }
    std::uint32_t end = 0;
    for (auto& first : first_) first = end += first;
    binned_.entries.resize(end);
    x_.resize(end + PointSieve<false>::at_once);
    y_.resize(end + PointSieve<false>::at_once);
    for (std::uint32_t i = nodes; i-- > 0;) {
        const IndexEntry& entry = all.entries[i];
        if (speeds[i] > top_speed) {
            apart_.put(add_apart(entry.node), entry, all.motion(i));
            continue;
        }
        const std::uint32_t place = place_[entry.node.index()] = --first_[cell[i]];
        binned_.put(place, entry, all.motion(i));
        const Vec3 p = all.position(i, t, legs);
        x_[place] = static_cast<float>(p.x);
        y_[place] = static_cast<float>(p.y);
    }
    allowed_apart_ = apart_.entries.size() + few(nodes);
    stale_ = false;
    ++bins_;
}

}  // namespace rovernet
