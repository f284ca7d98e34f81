// SPDX-License-Identifier: MIT
#include "models/propagation/edges/edge_row.hpp"

#include "models/propagation/edges/edge_pair.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rovernet {
namespace {

struct Stretch {
    double length, angle;  // [m], [rad] upwards
};
Stretch stretch(double along, double up) {
    return {std::sqrt(along * along + up * up), math::atan2(up, along)};
}

/// Detour of the path by a corner, compared with the straight line between its neighbours [m];
/// negative if the path bends away from the body.
double longer_by(const Stretch& before, double bend, const Stretch& behind) {
    const double turn = before.angle - behind.angle + bend;
    const double half = math::sincos(turn / 2).sin, sum = before.length + behind.length;
    const double across = 4 * before.length * behind.length * half * half;
    return std::copysign(across / (sum + std::sqrt(std::max(0.0, sum * sum - across))), turn);
}

}  // namespace

EdgeRow::EdgeRow(std::vector<RowCorner> corners, double length, double wavelength)
    : corners_(std::move(corners)), length_(length), wavelength_(wavelength) {
    for (const RowCorner& c : corners_)
        alone_.push_back(screen_field(
            longer_by(stretch(c.at, -c.below), c.bend, stretch(length - c.at, c.below)),
            wavelength));
    for (std::size_t i = 0; i < corners_.size(); ++i)
        for (std::size_t k = i + 1; k < corners_.size(); ++k) links_.push_back(link(i, k));
    std::stable_sort(links_.begin(), links_.end(),
                     [](const Link& a, const Link& b) { return a.weight > b.weight; });
}

/// Field past two corners, divided by the fields past each.
EdgeRow::Link EdgeRow::link(std::size_t i, std::size_t k) const {
    const RowCorner &a = corners_[i], &b = corners_[k];
    const Stretch before = stretch(a.at, -a.below), along = stretch(b.at - a.at, a.below - b.below),
                  after = stretch(length_ - b.at, b.below);
    if (!(along.length > 0)) return {i, k, 1, 0};
    const bool one_body = a.body == b.body;
    const EdgePair pair{.before = before.length,
                        .along = along.length,
                        .after = after.length,
                        .first = longer_by(before, a.bend, along),
                        .last = longer_by(along, b.bend, after),
                        .face = one_body};
    // A corner far below the path to its neighbour has no effect.
    const double far = -near_edge * wavelength_;
    const math::Complex both = pair.first <= far  ? alone_[k]
                               : pair.last <= far ? alone_[i]
                                                  : pair_field(pair, wavelength_);
    const math::Complex factor = math::quotient(both, alone_[i] * alone_[k]);
    return {i, k, factor,
            one_body && k == i + 1 ? std::numeric_limits<double>::infinity()
                                   : std::sqrt(std::norm(factor))};
}

math::Complex EdgeRow::field_without(std::span<const char> left_out) const {
    std::vector<std::size_t> tree(corners_.size());
    std::iota(tree.begin(), tree.end(), std::size_t{0});
    math::Complex field = 1;
    for (std::size_t i = 0; i < corners_.size(); ++i)
        if (!left_out[corners_[i].body]) field *= alone_[i];
    for (const Link& link : links_) {
        if (left_out[corners_[link.i].body] || left_out[corners_[link.k].body]) continue;
        if (tree[link.i] == tree[link.k] || link.weight <= 1) continue;
        field *= link.factor;
        std::replace(tree.begin(), tree.end(), std::size_t{tree[link.k]}, tree[link.i]);
    }
    return field;
}

}  // namespace rovernet
