// SPDX-License-Identifier: MIT
#include "scene/wall_thickness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

namespace rovernet {
namespace {

/// Step from one cell of a chord to the next [cells].
struct Step {
    int right, up;
};

/// Chord of a wall: consecutive cells in one direction.
struct Chord {
    int column, row;  // of its first cell
    int cells = 0;
};

/// Chords of a layer's walls in one direction, from which the thickness is computed.
class Chords {
  public:
    /// @param is_wall  whether a cell of the map is a wall
    template <class IsWall>
    Chords(int columns, int rows, Step step, const IsWall& is_wall)
        : columns_(columns), rows_(rows), step_(step), chord_at_(count(columns, rows), none) {
        for (int row = 0; row < rows; ++row) begin_line(0, row, is_wall);
        for (int column = 1; column < columns; ++column) begin_line(column, 0, is_wall);
    }

    std::size_t size() const { return chords_.size(); }
    const Chord& operator[](std::size_t i) const { return chords_[i]; }
    Step step() const { return step_; }

    /// Mean number of cells of a chord and its neighbours, and the vector [cells] along the wall
    /// from the middle of the first to the middle of the last; 0 if the wall is straight there.
    struct Stretch {
        double cells, right, up;
    };
    Stretch stretch(std::size_t i) const;

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr int most_beside = 12;  // chords on each side

    static std::size_t count(int columns, int rows) {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
    std::size_t number(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    bool is_on_map(int column, int row) const {
        return column >= 0 && column < columns_ && row >= 0 && row < rows_;
    }
    /// Finds the chords on the line that enters the map at a cell, if there is one.
    template <class IsWall>
    void begin_line(int column, int row, const IsWall& is_wall) {
        if (step_.right < 0) column = columns_ - 1 - column;
        if (is_on_map(column - step_.right, row - step_.up)) return;
        bool inside = false;
        for (; is_on_map(column, row); column += step_.right, row += step_.up) {
            const bool solid = is_wall(column, row);
            if (solid && !inside) chords_.push_back({column, row});
            inside = solid;
            if (!solid) continue;
            ++chords_.back().cells;
            chord_at_[number(column, row)] = static_cast<std::uint32_t>(chords_.size() - 1);
        }
    }
    /// Neighbouring chord on one side that touches this one; `none` if there is none.
    std::uint32_t beside(std::size_t i, int side) const;
    double middle_column(const Chord& c) const {
        return c.column + step_.right * (c.cells - 1) / 2.0;
    }
    double middle_row(const Chord& c) const { return c.row + step_.up * (c.cells - 1) / 2.0; }
    /// Whether both ends of one chord lie beside those of the other.
    bool is_straight(std::size_t i, std::size_t j) const {
        const Chord &a = chords_[i], &b = chords_[j];
        const bool beside = step_.up == 0 ? a.column == b.column : a.row == b.row;
        return (step_.up == 0 || step_.right == 0) && beside && a.cells == b.cells;
    }

    int columns_, rows_;
    Step step_;
    std::vector<Chord> chords_;
    std::vector<std::uint32_t> chord_at_;  // by cell
};

std::uint32_t Chords::beside(std::size_t i, int side) const {
    const Chord& chord = chords_[i];
    // Neighbouring lines of a diagonal are offset along the rows and along the columns.
    const std::array<Step, 2> to_next{
        step_.up == 0 ? Step{0, side} : Step{side, 0},
        step_.right == 0 || step_.up == 0 ? Step{0, 0} : Step{0, -side * step_.right}};
    const auto found = [&](int cell) {
        for (const Step to : to_next) {
            const int column = chord.column + cell * step_.right + to.right;
            const int row = chord.row + cell * step_.up + to.up;
            if ((to.right == 0 && to.up == 0) || !is_on_map(column, row)) continue;
            if (const std::uint32_t at = chord_at_[number(column, row)]; at != none) return at;
        }
        return none;
    };
    for (int off = 0; off <= chord.cells / 2; ++off) {
        for (const int cell : {chord.cells / 2 - off, chord.cells / 2 + off}) {
            if (cell >= chord.cells) continue;
            if (const std::uint32_t at = found(cell); at != none) return at;
        }
    }
    return none;
}

Chords::Stretch Chords::stretch(std::size_t i) const {
    constexpr int straight_enough = 2;  // chords beside
    constexpr int fewest = 5;           // chords that tell how a wall slants; its ends have fewer
    const Chord& chord = chords_[i];
    std::array<std::size_t, 2> ends{i, i};
    double cells = chord.cells;
    int number = 1;
    for (const int side : {-1, 1}) {
        std::size_t& end = ends[side > 0 ? 1 : 0];
        int straight = 0;
        for (int k = 0; k < most_beside; ++k) {
            const std::uint32_t next = beside(end, side);
            if (next == none || std::abs(chords_[next].cells - chord.cells) > 1) break;
            straight += straight == k && is_straight(i, next) ? 1 : 0;
            if (straight >= straight_enough) return {static_cast<double>(chord.cells), 0, 0};
            end = next;
            cells += chords_[next].cells;
            ++number;
        }
    }
    if (number < fewest) return {static_cast<double>(chord.cells), 0, 0};
    const Chord &first = chords_[ends[0]], &last = chords_[ends[1]];
    return {cells / number, middle_column(last) - middle_column(first),
            middle_row(last) - middle_row(first)};
}

}  // namespace

WallThickness::WallThickness(const MapFrame& frame, std::shared_ptr<const WallIndex> walls,
                             std::shared_ptr<const HollowWalls> hollows)
    : cell_width_(frame.cell_width()),
      cell_height_(frame.cell_height()),
      walls_(std::move(walls)),
      hollows_(std::move(hollows)) {}

void WallThickness::measure() const {
    const int columns = walls_->columns(), rows = walls_->rows();
    const auto is_wall = [&](int column, int row) {
        return walls_->solid(column, row) || hollows_->holds(column, row);
    };
    const auto cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    thickness_.assign(cells, 0);
    std::vector<float> shortest(cells, std::numeric_limits<float>::infinity());
    for (const Step step : {Step{1, 0}, Step{0, 1}, Step{1, 1}, Step{-1, 1}}) {
        const Chords chords(columns, rows, step, is_wall);
        const double dx = step.right * cell_width_, dy = step.up * cell_height_;
        const double step_m = std::sqrt(dx * dx + dy * dy);
        for (std::size_t i = 0; i < chords.size(); ++i) {
            const auto stretch = chords.stretch(i);
            const double x = stretch.right * cell_width_, y = stretch.up * cell_height_;
            const double along = std::sqrt(x * x + y * y), chord = stretch.cells * step_m;
            const double sine = along > 0 ? std::abs(dx * y - dy * x) / (step_m * along) : 1;
            const Chord& at = chords[i];
            for (int k = 0; k < at.cells; ++k) {
                const std::size_t cell = static_cast<std::size_t>(at.row + k * step.up) *
                                             static_cast<std::size_t>(columns) +
                                         static_cast<std::size_t>(at.column + k * step.right);
                if (static_cast<float>(chord) >= shortest[cell]) continue;
                shortest[cell] = static_cast<float>(chord);
                thickness_[cell] = static_cast<float>(chord * sine);
            }
        }
    }
}

}  // namespace rovernet
