// SPDX-License-Identifier: MIT
#include "scene/wall_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

/// Part of a segment, in fractions of it; uninitialised on purpose, see walk_tiles.
struct Piece {
    double from;
    double to;
};

/// One coordinate along a segment.
struct Axis {
    double start;
    double step;
    double inverse;  ///< infinite for a segment across this axis: at() is then -inf or +inf

    Axis(double from, double to) : start(from), step(to - from), inverse(1 / step) {}
    /// The fraction at which the segment meets a grid line. Monotone in `line`, rounding included.
    double at(int line) const { return (line - start) * inverse; }
    double enter(int low, int high) const { return std::min(at(low), at(high)); }
    double leave(int low, int high) const { return std::max(at(low), at(high)); }
    bool rises() const { return step >= 0; }
};

bool whole(double x) { return std::floor(x) == x; }

/// Joins pieces that come in order, closes gaps and drops pieces within the tolerance.
template <class Visit>
class Merge {
  public:
    Merge(double tolerance, Visit& visit) : tolerance_(tolerance), visit_(visit) {}

    /// False: the visitor has seen enough.
    bool add(Piece piece) {
        if (piece.from - open_.to <= tolerance_) {
            open_.to = std::max(open_.to, piece.to);
            return true;
        }
        const bool more = finish();
        open_ = piece;
        return more;
    }
    bool finish() { return !(open_.to - open_.from > tolerance_) || visit_(open_); }

  private:
    static constexpr double before = -std::numeric_limits<double>::max();
    double tolerance_;
    Visit& visit_;
    Piece open_{before, before};
};

/// The tile that the segment is in at the fraction t, or one before it. A position is rounded and
/// may lie in the next tile already; the fraction at which that tile begins tells.
int tile_at(const Axis& axis, double t, int tiles) {
    constexpr int size = WallIndex::tile_size;
    const double position = (axis.start + t * axis.step) / size;
    int k = static_cast<int>(std::clamp(std::floor(position), 0.0, tiles - 1.0));
    if (axis.rises()) {
        while (k > 0 && axis.at(k * size) > t) --k;
    } else {
        while (k + 1 < tiles && axis.at((k + 1) * size) > t) ++k;
    }
    return k;
}

std::vector<CellRectangle> cut_at_tiles(const std::vector<CellRectangle>& rectangles) {
    constexpr int size = WallIndex::tile_size;
    std::vector<CellRectangle> cut;
    for (const CellRectangle& r : rectangles)
        for (int j = r.row0 / size; j * size < r.row1; ++j)
            for (int i = r.column0 / size; i * size < r.column1; ++i)
                cut.push_back({std::max(r.column0, i * size), std::max(r.row0, j * size),
                               std::min(r.column1, (i + 1) * size),
                               std::min(r.row1, (j + 1) * size)});
    return cut;
}

}  // namespace

WallIndex::WallIndex(int columns, int rows, const std::vector<CellRectangle>& rectangles)
    : columns_(columns),
      rows_(rows),
      tile_columns_((columns + tile_size - 1) / tile_size),
      tile_rows_((rows + tile_size - 1) / tile_size),
      rectangles_(cut_at_tiles(rectangles)),
      solid_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
    const auto tile_of = [&](const CellRectangle& r) {
        return static_cast<std::size_t>(r.row0 / tile_size) *
                   static_cast<std::size_t>(tile_columns_) +
               static_cast<std::size_t>(r.column0 / tile_size);
    };
    std::stable_sort(rectangles_.begin(), rectangles_.end(),
                     [&](const auto& p, const auto& q) { return tile_of(p) < tile_of(q); });
    first_.assign(
        static_cast<std::size_t>(tile_columns_) * static_cast<std::size_t>(tile_rows_) + 1, 0);
    for (const CellRectangle& r : rectangles_) ++first_[tile_of(r) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    for (const CellRectangle& r : rectangles_)
        for (int row = r.row0; row < r.row1; ++row)
            std::fill_n(solid_.begin() + std::ptrdiff_t{row} * columns_ + r.column0,
                        r.column1 - r.column0, true);
}

bool WallIndex::solid(int column, int row) const {
    return column >= 0 && column < columns_ && row >= 0 && row < rows_ &&
           solid_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
}

bool WallIndex::holds(CellPoint p) const {
    return p.u >= 0 && p.u < columns_ && p.v >= 0 && p.v < rows_ &&
           solid(static_cast<int>(p.u), static_cast<int>(p.v));
}

bool WallIndex::surrounds(CellPoint p) const {
    if (!(p.u >= 0 && p.u <= columns_ && p.v >= 0 && p.v <= rows_)) return false;
    const int column = static_cast<int>(p.u);
    const int row = static_cast<int>(p.v);
    for (int j = whole(p.v) ? row - 1 : row; j <= row; ++j)
        for (int i = whole(p.u) ? column - 1 : column; i <= column; ++i)
            if (!solid(i, j)) return false;
    return true;
}

void WallIndex::crossings(CellPoint a, CellPoint b, double length,
                          std::vector<Crossing>& out) const {
    out.clear();
    const bool reversed = std::pair(b.u, b.v) < std::pair(a.u, a.v);
    if (reversed) std::swap(a, b);
    walk(a, b, [&](Piece p) {
        const double thickness = (p.to - p.from) * length;
        if (reversed)
            out.push_back({length - p.to * length, length - p.from * length, thickness});
        else
            out.push_back({p.from * length, p.to * length, thickness});
        return true;
    });
    if (reversed) std::reverse(out.begin(), out.end());
}

double WallIndex::solid_length(CellPoint a, CellPoint b, double length, double enough) const {
    if (std::pair(b.u, b.v) < std::pair(a.u, a.v)) std::swap(a, b);
    double sum = 0;
    walk(a, b, [&](Piece p) {
        sum += (p.to - p.from) * length;
        return sum <= enough;
    });
    return sum;
}

/// Visits the pieces of a segment in solid cells, in order and merged, until the visitor declines.
template <class Visit>
void WallIndex::walk(CellPoint a, CellPoint b, Visit visit) const {
    const double du = b.u - a.u;
    const double dv = b.v - a.v;
    const double cells = std::sqrt(du * du + dv * dv);
    if (!(cells > cell_tolerance)) {
        if (surrounds(a)) visit(Piece{0, 1});
        return;
    }
    Merge<Visit> merge(cell_tolerance / cells, visit);
    if ((du == 0 && whole(a.u)) || (dv == 0 && whole(a.v)))
        walk_line(a, b, merge);
    else
        walk_tiles(a, b, merge);
}

template <class Merge>
void WallIndex::walk_tiles(CellPoint a, CellPoint b, Merge& merge) const {
    const Axis x(a.u, b.u);
    const Axis y(a.v, b.v);
    const double start = std::max({0.0, x.enter(0, columns_), y.enter(0, rows_)});
    const double end = std::min({1.0, x.leave(0, columns_), y.leave(0, rows_)});
    if (!(start < end)) return;
    // A segment passes fewer than two cells per row and column of a tile, each in one rectangle.
    std::array<Piece, 2 * tile_size> pieces;
    int i = tile_at(x, start, tile_columns_);
    int j = tile_at(y, start, tile_rows_);
    for (;;) {
        std::size_t count = 0;
        for (const CellRectangle& r : tile(i, j)) {
            const Piece piece{
                std::max({0.0, x.enter(r.column0, r.column1), y.enter(r.row0, r.row1)}),
                std::min({1.0, x.leave(r.column0, r.column1), y.leave(r.row0, r.row1)})};
            if (!(piece.from < piece.to)) continue;
            std::size_t k = count++;
            for (; k > 0 && piece.from < pieces[k - 1].from; --k) pieces[k] = pieces[k - 1];
            pieces[k] = piece;
        }
        for (std::size_t k = 0; k < count; ++k)
            if (!merge.add(pieces[k])) return;
        const double next_x = x.at((x.rises() ? i + 1 : i) * tile_size);
        const double next_y = y.at((y.rises() ? j + 1 : j) * tile_size);
        if (std::min(next_x, next_y) >= end) break;
        if (next_x <= next_y)
            i += x.rises() ? 1 : -1;
        else
            j += y.rises() ? 1 : -1;
    }
    merge.finish();
}

/// Along a grid line: inside where the cells on both sides are solid.
template <class Merge>
void WallIndex::walk_line(CellPoint a, CellPoint b, Merge& merge) const {
    const bool upright = a.u == b.u;
    const double across = upright ? a.u : a.v;
    const int cells = upright ? rows_ : columns_;
    const Axis along = upright ? Axis(a.v, b.v) : Axis(a.u, b.u);
    if (!(across > 0 && across < (upright ? columns_ : rows_))) return;
    const int line = static_cast<int>(across);
    const int first = static_cast<int>(std::clamp(std::floor(along.start), 0.0, cells + 0.0));
    const double stop = std::ceil(along.start + along.step);
    const int last = static_cast<int>(std::clamp(stop, 0.0, cells + 0.0));
    for (int k = first; k < last; ++k) {
        if (upright ? !(solid(line - 1, k) && solid(line, k))
                    : !(solid(k, line - 1) && solid(k, line)))
            continue;
        const Piece piece{std::max(0.0, along.at(k)), std::min(1.0, along.at(k + 1))};
        if (piece.from < piece.to && !merge.add(piece)) return;
    }
    merge.finish();
}

}  // namespace rovernet
