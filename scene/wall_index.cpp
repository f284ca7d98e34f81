// SPDX-License-Identifier: MIT
#include "scene/wall_index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

/// Part of a segment, as fractions of it; uninitialised on purpose, see walk_tiles.
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
    /// Fraction at which the segment crosses a grid line. Monotone in `line`, also with rounding.
    double at(double line) const { return (line - start) * inverse; }
    /// Fractions of several grid lines at once.
    template <class Lines>
    Lines at_all(Lines lines) const {
        return (lines - start) * inverse;
    }
    double enter(double low, double high) const { return std::min(at(low), at(high)); }
    double leave(double low, double high) const { return std::max(at(low), at(high)); }
    bool rises() const { return step >= 0; }
};

bool whole(double x) { return std::floor(x) == x; }

/// Joins pieces in order, closes gaps and drops pieces within the tolerance.
template <class Visit>
class Merge {
  public:
    Merge(double tolerance, Visit& visit) : tolerance_(tolerance), visit_(visit) {}

    /// Adds a piece; false if the visitor needs no more.
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

/// Tile of the segment at the fraction t, or the one before it. A rounded position may lie in the
/// next tile already; the fraction at which that tile begins decides.
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
    group_by_two();
}

void WallIndex::group_by_two() {
    for (std::size_t t = 0; t + 1 < first_.size(); ++t) {
        first_two_.push_back(twos_.size());
        for (std::size_t i = first_[t]; i < first_[t + 1]; ++i) {
            const std::size_t k = (i - first_[t]) % 2;
            if (k == 0) twos_.push_back({});  // two empty rectangles: no segment passes them
            auto& sides = twos_.back().sides;
            sides[Two::left][k] = rectangles_[i].column0;
            sides[Two::right][k] = rectangles_[i].column1;
            sides[Two::bottom][k] = rectangles_[i].row0;
            sides[Two::top][k] = rectangles_[i].row1;
        }
    }
    first_two_.push_back(twos_.size());
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

/// Visits the merged pieces of a segment in solid cells, in order, until the visitor returns false.
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

/// Pieces of a segment in one tile, in order.
class WallIndex::TilePieces {
  public:
    TilePieces(const Axis& x, const Axis& y)
        : x_(x),
          y_(y),
          enter_x_(x.rises() ? Two::left : Two::right),
          leave_x_(x.rises() ? Two::right : Two::left),
          enter_y_(y.rises() ? Two::bottom : Two::top),
          leave_y_(y.rises() ? Two::top : Two::bottom) {}

    std::span<const Piece> in(std::span<const Two> tile) {
        std::size_t count = 0;
        for (const Two& two : tile) {
            const Pair from = larger(y_.at_all(two.sides[enter_y_]),
                                     larger(x_.at_all(two.sides[enter_x_]), Pair{0, 0}));
            const Pair to = smaller(y_.at_all(two.sides[leave_y_]),
                                    smaller(x_.at_all(two.sides[leave_x_]), Pair{1, 1}));
            // Without a branch, which would be mispredicted.
            for (std::size_t k = 0; k < 2; ++k) {
                pieces_[count] = {from[k], to[k]};
                count += from[k] < to[k];
            }
        }
        if (count > 1) sort(count);
        return {pieces_.data(), count};
    }

  private:
    // If both are equal, the second, like the processor's instruction: 0 replaces -0.
    static Pair larger(Pair a, Pair b) { return a > b ? a : b; }
    static Pair smaller(Pair a, Pair b) { return a < b ? a : b; }

    void sort(std::size_t count) {
        for (std::size_t i = 1; i < count; ++i) {
            const Piece piece = pieces_[i];
            std::size_t k = i;
            for (; k > 0 && piece.from < pieces_[k - 1].from; --k) pieces_[k] = pieces_[k - 1];
            pieces_[k] = piece;
        }
    }

    Axis x_, y_;
    std::size_t enter_x_, leave_x_, enter_y_, leave_y_;
    // A segment passes fewer than two cells per row and column of a tile, each in one rectangle;
    // one more is written, and not counted.
    std::array<Piece, 2 * tile_size + 1> pieces_;
};

template <class Merge>
void WallIndex::walk_tiles(CellPoint a, CellPoint b, Merge& merge) const {
    const Axis x(a.u, b.u);
    const Axis y(a.v, b.v);
    const double start = std::max({0.0, x.enter(0, columns_), y.enter(0, rows_)});
    const double end = std::min({1.0, x.leave(0, columns_), y.leave(0, rows_)});
    if (!(start < end)) return;
    TilePieces pieces(x, y);
    const int ahead_x = x.rises(), step_x = 2 * ahead_x - 1;
    const int ahead_y = y.rises(), step_y = 2 * ahead_y - 1;
    int i = tile_at(x, start, tile_columns_);
    int j = tile_at(y, start, tile_rows_);
    for (;;) {
        for (const Piece& piece : pieces.in(twos(i, j)))
            if (!merge.add(piece)) return;
        const double next_x = x.at((i + ahead_x) * tile_size);
        const double next_y = y.at((j + ahead_y) * tile_size);
        if (std::min(next_x, next_y) >= end) break;
        const bool along_x = next_x <= next_y;
        i += along_x ? step_x : 0;
        j += along_x ? 0 : step_y;
    }
    merge.finish();
}

/// Handles a segment along a grid line: it is inside if the cells on both sides are solid.
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
