// SPDX-License-Identifier: MIT
#pragma once

#include "scene/free_space.hpp"
#include "scene/map_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rovernet {

/// Length [m] of the shortest way that goes along the axes and diagonals of the cells.
///
/// All lengths of the search are in this norm, which makes it an exact bound on an empty map.
struct CellNorm {
    double width, height, diagonal;  ///< sides and diagonal of a cell [m]

    explicit CellNorm(const MapFrame& frame)
        : width(frame.cell_width()),
          height(frame.cell_height()),
          diagonal(std::sqrt(width * width + height * height)) {}

    double operator()(CellPoint a, CellPoint b) const {
        const double u = std::abs(b.u - a.u);
        const double v = std::abs(b.v - a.v);
        const double both = std::min(u, v);
        return both * diagonal + (u - both) * width + (v - both) * height;
    }
};

/// An end of a path, and straight ways between it and the centres of cells near it.
struct PathEnd {
    struct Access {
        int cell;
        double length;  ///< length in CellNorm [m]
    };
    CellPoint at;
    std::vector<Access> ways;  ///< access to each cell
};

/// Finds shortest ways over the cells of a map by A*, best first to within half a cell.
///
/// Cells to go on from lie in buckets by their total: the length so far plus the least that may be
/// left. A cell to which a shorter way turns up is put into a bucket again; the search ends when no
/// bucket is left that could shorten the way found. Of ways equally long but for rounding a cell
/// keeps the one whose last cell is nearest to the straight line between the ends. Boost's
/// astar_search takes four times as many instructions: it makes its arrays anew and keeps its heap
/// in full order.
///
/// Sources: P. E. Hart, N. J. Nilsson, B. Raphael, A Formal Basis for the Heuristic Determination
/// of Minimum Cost Paths, IEEE SSC-4 (1968); R. B. Dial, Algorithm 360, Comm. ACM 12 (1969).
class CellSearch {
  public:
    CellSearch(const MapFrame& frame, int columns);

    /// The cells from the start to the goal; none if there is no way. From the first call on it
    /// keeps 16 bytes for every cell of the map.
    /// @param steps  FreeSpace::steps, the same in every call
    std::vector<int> shortest_way(std::span<const std::uint8_t> steps, const PathEnd& start,
                                  const PathEnd& goal);

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Best way to a cell that is known so far.
    struct Reached {
        double so_far = infinity;  // [m] from the start
        int before = -1;           // the cell before it on the way; -1: the start
        float aside = 0;           // distance of `before` from the straight line, see aside()
    };
    /// A cell to go on from, unless a shorter way to it has been found meanwhile.
    struct Open {
        int cell;
        double so_far;
    };

    void begin(std::size_t cells, const PathEnd& start, const PathEnd& goal);
    CellPoint centre(int cell) const { return {cell % columns_ + 0.5, cell / columns_ + 0.5}; }
    double least_left(int cell) const { return norm_(centre(cell), goal_); }
    float aside(int cell) const;
    void reach(const Reached& way, int cell);
    void open(const Reached& way, int cell);
    void go_on(Open from, std::span<const std::uint8_t> steps);
    std::vector<int> way_to(int cell) const;

    CellNorm norm_;
    int columns_;
    double bucket_width_;                             // [m]
    double rounding_;                                 // [m] lengths so much apart are equal
    std::array<int, cell_steps.size()> offset_{};     // of a step: difference of the cells' indices
    std::array<double, cell_steps.size()> length_{};  // of a step [m]

    CellPoint start_{}, goal_{};
    std::vector<Reached> reached_;               // by cell
    std::vector<int> touched_;                   // cells whose entry in reached_ was changed
    std::array<std::vector<Open>, 32> buckets_;  // ring of buckets
    std::size_t bucket_ = 0;  // number of the current bucket, not yet modulo the ring
    std::size_t open_ = 0;    // cells in all buckets
    double least_ = 0;        // total at which the first bucket begins [m]
};

}  // namespace rovernet
