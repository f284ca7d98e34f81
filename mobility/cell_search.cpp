// SPDX-License-Identifier: MIT
#include "mobility/cell_search.hpp"

#include <bit>

namespace rovernet {

CellSearch::CellSearch(const MapFrame& frame, int columns, int margin)
    : norm_(frame),
      columns_(columns),
      margin_(margin),
      bucket_width_(std::min(norm_.width, norm_.height) / 2),
      rounding_(1e-9 * bucket_width_) {
    for (std::size_t d = 0; d < cell_steps.size(); ++d) {
        offset_[d] = cell_steps[d].row * columns + cell_steps[d].column;
        length_[d] = norm_({0, 0}, {cell_steps[d].column + 0.0, cell_steps[d].row + 0.0});
    }
}

std::vector<int> CellSearch::shortest_way(std::span<const std::uint8_t> steps, const PathEnd& start,
                                          const PathEnd& goal) {
    begin(steps.size(), start, goal);
    int last = -1;
    double shortest = infinity;
    const auto least_in = [&](std::size_t bucket) {
        return least_ + static_cast<double>(bucket) * bucket_width_;
    };
    for (; open_ > 0 && least_in(bucket_) < shortest; ++bucket_) {
        auto& bucket = buckets_[bucket_ % buckets_.size()];
        for (std::size_t k = 0; k < bucket.size(); ++k) go_on(bucket[k], steps);  // it may grow
        open_ -= bucket.size();
        bucket.clear();
        for (const auto& [cell, length] : goal.ways) {
            const double whole = reached_[static_cast<std::size_t>(cell)].so_far + length;
            if (whole >= shortest) continue;
            shortest = whole;
            last = cell;
        }
    }
    return way_to(last);
}

/// Resets the search and opens the cells near the start.
void CellSearch::begin(std::size_t cells, const PathEnd& start, const PathEnd& goal) {
    for (const int cell : touched_) reached_[static_cast<std::size_t>(cell)] = {};
    touched_.clear();
    reached_.resize(cells);
    for (auto& bucket : buckets_) bucket.clear();
    bucket_ = open_ = 0;
    start_ = start.at;
    goal_ = goal.at;
    least_ = infinity;
    for (const auto& [cell, length] : start.ways) {
        least_ = std::min(least_, length + least_left(cell));
    }
    for (const auto& [cell, length] : start.ways) reach({length, -1, 0}, cell);
}

/// Distance of a cell from the straight line between the ends, in units of this search.
float CellSearch::aside(int cell) const {
    const CellPoint p = centre(cell);
    return static_cast<float>(std::abs((p.u - start_.u) * (goal_.v - start_.v) -
                                       (p.v - start_.v) * (goal_.u - start_.u)));
}

/// Handles a path that reaches a cell.
void CellSearch::reach(const Reached& way, int cell) {
    Reached& known = reached_[static_cast<std::size_t>(cell)];
    const double longer = way.so_far - known.so_far;
    if (longer > rounding_) return;
    if (longer < -rounding_) return open(way, cell);
    if (way.aside < known.aside) known = {known.so_far, way.before, way.aside};
}

/// Opens a cell for a path that is shorter than the known one.
void CellSearch::open(const Reached& way, int cell) {
    Reached& known = reached_[static_cast<std::size_t>(cell)];
    if (known.so_far == infinity) touched_.push_back(cell);
    known = way;
    const double above = (way.so_far + least_left(cell) - least_) / bucket_width_;
    const auto bucket = std::max(static_cast<std::size_t>(std::max(above, 0.0)), bucket_);
    // A cell beyond the last bucket is put into an earlier one, which is harmless.
    buckets_[bucket % buckets_.size()].push_back({cell, way.so_far});
    ++open_;
}

/// Handles all steps from a cell.
void CellSearch::go_on(Open from, std::span<const std::uint8_t> steps) {
    const auto i = static_cast<std::size_t>(from.cell);
    if (reached_[i].so_far < from.so_far) return;
    Reached way{0, from.cell, aside(from.cell)};
    for (std::uint32_t left = steps[i]; left != 0; left &= left - 1) {
        const auto d = static_cast<std::size_t>(std::countr_zero(left));
        way.so_far = from.so_far + length_[d];
        reach(way, from.cell + offset_[d]);
    }
}

std::vector<int> CellSearch::way_to(int cell) const {
    std::vector<int> way;
    for (; cell >= 0; cell = reached_[static_cast<std::size_t>(cell)].before) way.push_back(cell);
    std::reverse(way.begin(), way.end());
    return way;
}

}  // namespace rovernet
