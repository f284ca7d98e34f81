// SPDX-License-Identifier: MIT
#pragma once

#include "mobility/free_space.hpp"
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

/// Length [m] of the shortest path between two points along the axes and diagonals of map cells.
///
/// CellSearch measures all lengths by this norm. The norm is a lower bound for the length of a path
/// around obstacles, and exact without obstacles.
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

/// Start or goal of a path, with straight connections to the centres of cells nearby.
struct PathEnd {
    struct Access {
        int cell;
        double length;  ///< length of the connection in CellNorm [m]
    };
    CellPoint at;
    std::vector<Access> ways;  ///< connections to the centres of cells nearby
};

/// Search for shortest paths over the cells of a map by A*. Cells are visited in ascending order of
/// their estimates, to within half a cell.
///
/// Open cells are stored in buckets by their estimate: the length so far plus the lower bound of
/// the rest. A cell for which a shorter path is found is put into a bucket again. The search ends
/// when no cell in any bucket could shorten the path found. Among paths of equal length (except for
/// rounding) a cell keeps the one whose previous cell is nearest to the straight line between the
/// ends. Boost's astar_search takes four times as many instructions: it allocates its arrays for
/// each search and keeps its heap fully ordered.
///
/// Sources: P. E. Hart, N. J. Nilsson, B. Raphael, A Formal Basis for the Heuristic Determination
/// of Minimum Cost Paths, IEEE SSC-4 (1968); R. B. Dial, Algorithm 360, Comm. ACM 12 (1969).
class CellSearch {
  public:
    /// @param columns  columns of cells, with the margin
    /// @param margin   cells beyond each side of the grid of `frame`, see FreeSpace
    CellSearch(const MapFrame& frame, int columns, int margin = 0);

    /// Indices of the cells on the shortest path from start to goal; empty if there is no path.
    /// The first call allocates 16 bytes for every cell of the map, which the CellSearch keeps.
    /// @param steps  possible steps from each cell, see FreeSpace::steps; the same in every call
    std::vector<int> shortest_way(std::span<const std::uint8_t> steps, const PathEnd& start,
                                  const PathEnd& goal);

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Shortest path to a cell found so far.
    struct Reached {
        double so_far = infinity;  // length from the start [m]
        int before = -1;           // previous cell of the path; -1: the start
        float aside = 0;           // distance of `before` from the straight line start-goal
    };
    /// Cell in the open list of A*; obsolete if a shorter path to the cell was found since.
    struct Open {
        int cell;
        double so_far;
    };

    void begin(std::size_t cells, const PathEnd& start, const PathEnd& goal);
    CellPoint centre(int cell) const {
        return {cell % columns_ - margin_ + 0.5, cell / columns_ - margin_ + 0.5};
    }
    double least_left(int cell) const { return norm_(centre(cell), goal_); }
    float aside(int cell) const;
    void reach(const Reached& way, int cell);
    void open(const Reached& way, int cell);
    void go_on(Open from, std::span<const std::uint8_t> steps);
    std::vector<int> way_to(int cell) const;

    CellNorm norm_;
    int columns_, margin_;
    double bucket_width_;                             // [m] range of estimates in a bucket
    double rounding_;                                 // [m] lengths that differ by less are equal
    std::array<int, cell_steps.size()> offset_{};     // difference of cell indices, by step
    std::array<double, cell_steps.size()> length_{};  // length of a step [m], by step

    CellPoint start_{}, goal_{};
    std::vector<Reached> reached_;               // best path found so far, by cell
    std::vector<int> touched_;                   // cells whose entry in reached_ was changed
    std::array<std::vector<Open>, 32> buckets_;  // buckets of the open list, as a ring
    std::size_t bucket_ = 0;  // number of the current bucket, not reduced modulo the ring's size
    std::size_t open_ = 0;    // number of cells in all buckets
    double least_ = 0;        // estimate at which the first bucket begins [m]
};

}  // namespace rovernet
