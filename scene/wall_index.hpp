// SPDX-License-Identifier: MIT
#pragma once

#include "scene/map_frame.hpp"
#include "scene/rectangles.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rovernet {

/// One passage of a segment a-b through walls, measured along the segment from a.
struct Crossing {
    double entry;              ///< [m]
    double exit;               ///< [m]
    double length;             ///< exit - entry [m]; the same bits from a to b as from b to a
    std::size_t material = 0;  ///< index into the scene's materials
    friend constexpr bool operator==(Crossing, Crossing) = default;
};

/// Solid cells of a map as rectangles in square tiles, for walking a segment through them.
///
/// Works in cells. A grid line x = k is met at the fraction (k - ax) * (1 / (bx - ax)) of the
/// segment, for whichever rectangle asks; so rectangles side by side share their fractions exactly,
/// and the union of the pieces is the same, to the last bit, however the cells were cut. Rectangles
/// are cut at tile borders: each lies in one tile, and tiles along the segment come in order.
class WallIndex {
  public:
    static constexpr int tile_size = 64;  ///< [cells]

    WallIndex() = default;
    /// @param rectangles  disjoint, inside columns x rows; may touch
    WallIndex(int columns, int rows, const std::vector<CellRectangle>& rectangles);

    bool empty() const { return rectangles_.empty(); }
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    /// The cell is solid; none outside of the map is.
    bool solid(int column, int row) const;
    int tile_columns() const { return tile_columns_; }
    int tile_rows() const { return tile_rows_; }
    /// The rectangles inside one tile.
    std::span<const CellRectangle> tile(int column, int row) const {
        const std::size_t i = tile_number(column, row);
        return std::span(rectangles_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

    /// Writes the crossings of a segment that is `length` [m] long, in order from a.
    /// @param out  emptied first
    void crossings(CellPoint a, CellPoint b, double length, std::vector<Crossing>& out) const;
    /// Sum of the crossings' lengths [m]; stops counting once the sum exceeds `enough` [m].
    double solid_length(CellPoint a, CellPoint b, double length, double enough) const;
    /// The point lies in a solid cell; left and lower edges belong to a cell, others do not.
    bool holds(CellPoint p) const;
    /// Every cell that holds or touches the point is solid.
    bool surrounds(CellPoint p) const;

  private:
    /// Two numbers on which the processor works at once.
    using Pair [[gnu::vector_size(16)]] = double;
    /// Two rectangles of a tile.
    struct Two {
        enum Side { left, right, bottom, top };
        std::array<Pair, 4> sides;  // by side [cells]
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
    std::vector<std::size_t> first_;         ///< of each tile's rectangles; one more than tiles
    std::vector<CellRectangle> rectangles_;  ///< by tile, row by row
    std::vector<std::size_t> first_two_;     ///< of each tile's twos; one more than tiles
    std::vector<Two> twos_;    ///< the rectangles again; of an odd number the last is alone
    std::vector<bool> solid_;  ///< columns * rows
};

}  // namespace rovernet
