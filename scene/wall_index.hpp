// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/materials/material.hpp"
#include "scene/rectangles.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rovernet {

/// Spatial index of a map's solid cells: rectangles in square tiles, for finding the passages of a
/// segment through solid cells.
///
/// All calculations are in cells. A segment crosses a grid line x = k at the fraction (k - ax) * (1
/// / (bx - ax)) of its length, the same for every rectangle. So adjacent rectangles share their
/// fractions exactly. The union of the pieces is the same to the last bit for any division into
/// rectangles. Rectangles are cut at tile borders, so that each lies in one tile. Tiles along the
/// segment are visited in order.
class WallIndex {
  public:
    static constexpr int tile_size = 64;  ///< side of a tile [cells]

    WallIndex() = default;
    /// @param rectangles  solid cells: disjoint rectangles inside columns x rows, which may touch
    WallIndex(int columns, int rows, const std::vector<CellRectangle>& rectangles);

    bool empty() const { return rectangles_.empty(); }
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    /// Whether the cell is solid; false outside the map.
    bool solid(int column, int row) const;
    int tile_columns() const { return tile_columns_; }
    int tile_rows() const { return tile_rows_; }
    /// Rectangles of solid cells in one tile, given by the tile's column and row.
    std::span<const CellRectangle> tile(int column, int row) const {
        const std::size_t i = tile_number(column, row);
        return std::span(rectangles_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

    /// Computes the passages of the segment a-b through solid cells, in order from a.
    /// @param length  length of the segment [m]
    /// @param out     replaced by the passages
    void crossings(CellPoint a, CellPoint b, double length, std::vector<Crossing>& out) const;
    /// Total length of the segment a-b inside solid cells [m]; counting stops once the total
    /// exceeds `enough` [m]. `length` is the length of the segment [m].
    double solid_length(CellPoint a, CellPoint b, double length, double enough) const;
    /// Whether the point lies in a solid cell; a cell includes its left and lower edges only.
    bool holds(CellPoint p) const;
    /// Whether all map cells that contain the point, or whose border it lies on, are solid (walls).
    bool surrounds(CellPoint p) const;

  private:
    /// Two numbers, for a SIMD instruction.
    using Pair [[gnu::vector_size(16)]] = double;
    /// Coordinates of two rectangles of a tile, for SIMD instructions.
    struct Two {
        enum Side { left, right, bottom, top };
        std::array<Pair, 4> sides;  // coordinates of both rectangles, by Side [cells]
    };
    class TilePieces;

    void group_by_two();
    std::span<const Two> twos(int column, int row) const {
        const std::size_t i = tile_number(column, row);
        return std::span(twos_).subspan(first_two_[i], first_two_[i + 1] - first_two_[i]);
    }
    std::size_t tile_number(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(tile_columns_) +
               static_cast<std::size_t>(column);
    }
    template <class Visit>
    void walk(CellPoint a, CellPoint b, Visit visit) const;
    template <class Merge>
    void walk_tiles(CellPoint a, CellPoint b, Merge& merge) const;
    template <class Merge>
    void walk_line(CellPoint a, CellPoint b, Merge& merge) const;

    int columns_ = 0;
    int rows_ = 0;
    int tile_columns_ = 0;
    int tile_rows_ = 0;
    std::vector<std::size_t> first_;  ///< index of each tile's first rectangle; size: tiles + 1
    std::vector<CellRectangle> rectangles_;  ///< rectangles of all tiles, row by row of tiles
    std::vector<std::size_t> first_two_;  ///< index in twos_ of each tile's first; size: tiles + 1
    std::vector<Two> twos_;  ///< rectangles of each tile in pairs; the last pair may be half empty
    std::vector<bool> solid_;  ///< true for solid cells, row by row; columns * rows elements
};

}  // namespace rovernet
