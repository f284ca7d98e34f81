// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

// Axis of a grid with bounded memory over an unbounded plane:
//
//     const WrappedAxis axis(100, 64);          // 64 cells of 100 m
//     axis.cell_at(50) == axis.cell_at(6450);   // one period of 6400 m further
//     axis.near(10, 150).count() == 4;          // cells from -140 m to 160 m

namespace rovernet {

/// Axis of a grid whose cells wrap around: a fixed number of cells of equal width covers the whole
/// line. Cell c represents the intervals number c, c + cells, c + 2 cells ...
///
/// Therefore a grid needs no bounds and never grows, wherever robots move. Distant intervals may
/// share a cell: the caller of a query has to check the distances. Two axes form a grid, as in the
/// index of the medium (NeighbourIndex) and in the index of frames on air (OnAir).
class WrappedAxis {
  public:
    /// @param width  width of a cell [m], > 0
    /// @param cells  number of cells, > 0
    explicit WrappedAxis(double width = 1, std::size_t cells = 1)
        : width_(width), per_meter_(1 / width), cells_(cells) {}

    /// Width of a cell [m].
    double width() const { return width_; }
    /// Number of cells.
    std::size_t cells() const { return cells_; }

    /// Cell of the coordinate `x` [m], in 0 ... cells() - 1.
    std::size_t cell_at(double x) const { return wrapped(unwrapped(x)); }

    /// Cells found by a query: a range [begin, end), and a second range [0, wrapped_end) if the
    /// cells wrap around.
    struct Cells {
        std::size_t begin, end, wrapped_end;

        /// Number of cells in both ranges.
        std::size_t count() const { return end - begin + wrapped_end; }
        /// Calls use(begin, end) for each range that is not empty.
        template <class Use>
        void each(Use use) const {
            use(begin, end);
            if (wrapped_end > 0) use(std::size_t{0}, wrapped_end);
        }
    };
    /// Cells for coordinates from `centre` - `reach` to `centre` + `reach` [m], each cell once;
    /// `reach` may be infinite. A margin for rounding is added, so that no cell is missed. An
    /// interval longer than the axis gives all cells.
    Cells near(double centre, double reach) const {
        const double rounding = 1e-9 * (std::abs(centre) + reach);
        const std::int64_t first = unwrapped(centre - reach - rounding);
        const std::int64_t last = unwrapped(centre + reach + rounding);
        const auto count = std::min(static_cast<std::size_t>(last - first) + 1, cells_);
        const std::size_t begin = wrapped(first), end = begin + count;
        return {begin, std::min(end, cells_), end > cells_ ? end - cells_ : 0};
    }

  private:
    // Distance from the origin [cells] beyond which all positions share the last cell.
    static constexpr double far = 1e15;

    // Number of the interval that contains `x` [m], counted from the origin.
    std::int64_t unwrapped(double x) const {
        return static_cast<std::int64_t>(std::floor(std::min(far, std::max(-far, x * per_meter_))));
    }
    // Number of the stored cell for the interval number `cell` of the unbounded axis.
    std::size_t wrapped(std::int64_t cell) const {
        const auto n = static_cast<std::int64_t>(cells_);
        // Most intervals need no division, which would take longer than the rest of this class.
        const std::int64_t rest = cell >= 0 && cell < n ? cell : cell % n;
        return static_cast<std::size_t>(rest < 0 ? rest + n : rest);
    }

    double width_;
    // Number of cells per metre [1/m].
    double per_meter_;
    std::size_t cells_;
};

}  // namespace rovernet
