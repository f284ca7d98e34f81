// SPDX-License-Identifier: MIT
#include "study/validation/cases/naive_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

constexpr double beyond = std::numeric_limits<double>::infinity();

/// Way of a line along one axis, in shares of its length.
struct AxisWalk {
    std::int64_t cell, step;
    double next, stride;  // share at the next border, and from border to border

    AxisWalk(double from, double to)
        : cell(static_cast<std::int64_t>(std::floor(from))),
          step(to > from ? 1 : -1),
          next(beyond),
          stride(beyond) {
        if (to == from) return;
        stride = 1 / std::abs(to - from);
        const double border = static_cast<double>(step > 0 ? cell + 1 : cell);
        next = (border - from) / (to - from);
    }
    void advance() {
        cell += step;
        next += stride;
    }
};

}  // namespace

NaiveRaster::NaiveRaster(Vec3 low, Vec3 high, double cell, const std::function<bool(Vec3)>& is_wall)
    : low_(low),
      cell_(cell),
      columns_(static_cast<std::int64_t>(std::ceil((high.x - low.x) / cell))),
      rows_(static_cast<std::int64_t>(std::ceil((high.y - low.y) / cell))) {
    cells_.reserve(static_cast<std::size_t>(columns_ * rows_));
    for (std::int64_t row = 0; row < rows_; ++row) {
        for (std::int64_t column = 0; column < columns_; ++column) {
            const double x = static_cast<double>(column) + 0.5, y = static_cast<double>(row) + 0.5;
            cells_.push_back(is_wall({low.x + x * cell, low.y + y * cell}));
        }
    }
}

double NaiveRaster::traversed(Vec3 a, Vec3 b) const {
    const Vec3 from = in_cells(a), to = in_cells(b);
    AxisWalk x(from.x, to.x), y(from.y, to.y);
    double at = 0, inside = 0;
    while (at < 1) {
        const double border = std::min({x.next, y.next, 1.0});
        if (wall(x.cell, y.cell)) inside += border - at;
        at = border;
        (x.next <= y.next ? x : y).advance();
    }
    return inside * distance(a, b);
}

double NaiveRaster::bresenham(Vec3 a, Vec3 b) const {
    const Vec3 from = in_cells(a), to = in_cells(b);
    auto column = static_cast<std::int64_t>(from.x), row = static_cast<std::int64_t>(from.y);
    const auto last_column = static_cast<std::int64_t>(to.x),
               last_row = static_cast<std::int64_t>(to.y);
    const std::int64_t dx = std::abs(last_column - column), dy = std::abs(last_row - row);
    const std::int64_t step_x = column < last_column ? 1 : -1, step_y = row < last_row ? 1 : -1;
    std::int64_t error = dx - dy, cells = 0, inside = 0;
    for (;;) {
        ++cells;
        inside += wall(column, row);
        if (column == last_column && row == last_row) break;
        const std::int64_t twice = 2 * error;
        if (twice > -dy) {
            error -= dy;
            column += step_x;
        }
        if (twice < dx) {
            error += dx;
            row += step_y;
        }
    }
    return distance(a, b) * static_cast<double>(inside) / static_cast<double>(cells);
}

}  // namespace rovernet
