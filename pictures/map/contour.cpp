// SPDX-License-Identifier: MIT
#include "pictures/map/contour.hpp"

#include "sim/fields.hpp"
#include "sim/math.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace rovernet {
namespace {

/// Numbers on a grid: those of a map's cells, and one more all around, equal to its neighbour.
struct Grid {
    int columns = 0, rows = 0;
    std::vector<double> values = {};

    double& at(int column, int row) {
        return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                      static_cast<std::size_t>(column)];
    }
    double at(int column, int row) const { return const_cast<Grid&>(*this).at(column, row); }
};

/// Height of each cell above the level [dB], within narrow bounds.
Grid excess(const CoverageMap& map, Dbm level) {
    constexpr double most = 0.5;  // [dB]
    Grid out{map.columns + 2, map.rows + 2, {}};
    out.values.reserve(static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows));
    for (int row = 0; row < out.rows; ++row) {
        for (int column = 0; column < out.columns; ++column) {
            const double dbm = map.at(std::clamp(column - 1, 0, map.columns - 1),
                                      std::clamp(row - 1, 0, map.rows - 1));
            out.values.push_back(std::clamp(dbm - level.value, -most, most));
        }
    }
    return out;
}

/// The right half of a Gaussian, its middle first, that sums to 1 with both halves.
std::vector<double> kernel(double sigma) {
    constexpr double most_sigmas = 3, most_cells = 200;
    const auto radius = static_cast<std::size_t>(std::min(most_sigmas * sigma, most_cells));
    std::vector<double> out{1};
    double sum = 1;
    for (std::size_t i = 1; i <= radius; ++i) {
        const double x = static_cast<double>(i) / sigma;
        out.push_back(math::exp2(-0.5 * x * x * 1.4426950408889634));
        sum += 2 * out.back();
    }
    for (double& weight : out) weight /= sum;
    return out;
}

/// The field smoothed along its rows, or along its columns. @param sigma  [cells]
Grid smoothed(const Grid& field, double sigma, bool along_rows) {
    const std::vector<double> weights = kernel(sigma);
    const int last = (along_rows ? field.columns : field.rows) - 1;
    Grid out = field;
    for (int row = 0; row < field.rows; ++row) {
        for (int column = 0; column < field.columns; ++column) {
            const int i = along_rows ? column : row;
            const auto value = [&](int k) {
                const int held = std::clamp(k, 0, last);
                return along_rows ? field.at(held, row) : field.at(column, held);
            };
            double sum = weights[0] * value(i);
            for (std::size_t k = 1; k < weights.size(); ++k) {
                const int step = static_cast<int>(k);
                sum += weights[k] * (value(i - step) + value(i + step));
            }
            out.at(column, row) = sum;
        }
    }
    return out;
}

/// The lines of a field's zeros. They cross the edges between neighbouring values; an edge is
/// numbered by its left or lower end, even along a row, odd along a column.
class Tracer {
  public:
    Tracer(const Grid& field, const CoverageMap& map)
        : field_(field), map_(map), next_(2 * field.values.size(), none) {}

    std::vector<ContourLine> lines();

  private:
    using Edge = std::uint32_t;
    static constexpr Edge none = UINT32_MAX;

    Edge edge(int column, int row, bool along_column) const {
        return 2 * static_cast<Edge>(row * field_.columns + column) + (along_column ? 1 : 0);
    }
    void cross(int column, int row);
    Vec3 place(Edge edge) const;
    ContourLine line_from(Edge first);

    const Grid& field_;
    const CoverageMap& map_;
    std::vector<Edge> next_;  // where the line through an edge goes on; none: there is no line
};

/// Joins the edges of the square with this lower left corner by the lines through it; values above
/// 0 are on the left of a line.
void Tracer::cross(int column, int row) {
    const std::array<double, 4> corner{field_.at(column, row), field_.at(column + 1, row),
                                       field_.at(column + 1, row + 1), field_.at(column, row + 1)};
    const std::array<Edge, 4> side{edge(column, row, false), edge(column + 1, row, true),
                                   edge(column, row + 1, false), edge(column, row, true)};
    // Counter-clockwise along side i, from corner i to i + 1: a line goes out where the sign turns
    // to above, and comes in where it turns to below.
    std::array<Edge, 2> in{none, none}, out{none, none};
    std::size_t ins = 0, outs = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const bool here = corner[i] >= 0, there = corner[(i + 1) % 4] >= 0;
        if (here && !there) in[ins++] = side[i];
        if (!here && there) out[outs++] = side[i];
    }
    if (ins == 0) return;
    if (ins == 2) {
        // Two lines cross this square, and each cuts off a corner: the corners above the level if
        // the middle is below it, else those below.
        const bool middle = corner[0] + corner[1] + corner[2] + corner[3] >= 0;
        const bool first_above = corner[0] >= 0;
        if (first_above != middle) std::swap(out[0], out[1]);
    }
    for (std::size_t i = 0; i < ins; ++i) next_[in[i]] = out[i];
}

Vec3 Tracer::place(Edge edge) const {
    const bool along_column = edge % 2 == 1;
    const int index = static_cast<int>(edge / 2);
    const int column = index % field_.columns, row = index / field_.columns;
    const double a = field_.at(column, row);
    const double b = field_.at(column + !along_column, row + along_column);
    const double share = a / (a - b);
    const Vec3 low = map_.centre(column - 1, row - 1);
    return {low.x + (along_column ? 0 : share * map_.cell_width),
            low.y + (along_column ? share * map_.cell_height : 0), low.z};
}

ContourLine Tracer::line_from(Edge first) {
    ContourLine out;
    Edge at = first;
    while (at != none) {
        out.points.push_back(place(at));
        at = std::exchange(next_[at], none);
        if (at != first) continue;
        out.closed = true;
        break;
    }
    return out;
}

std::vector<ContourLine> Tracer::lines() {
    for (int row = 0; row + 1 < field_.rows; ++row) {
        for (int column = 0; column + 1 < field_.columns; ++column) cross(column, row);
    }
    std::vector<bool> entered(next_.size(), false);
    for (const Edge to : next_) {
        if (to != none) entered[to] = true;
    }
    std::vector<ContourLine> out;
    for (const bool closed : {false, true}) {  // those that begin at the map's edge come first
        for (Edge first = 0; first < next_.size(); ++first) {
            if (next_[first] == none || entered[first] != closed) continue;
            out.push_back(line_from(first));
        }
    }
    return out;
}

/// Whether a closed line encloses an area that is too small or too narrow to be meaningful.
bool is_speck(const ContourLine& line, Meters smoothing) {
    double area = 0, length = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Vec3 a = line.points[i], b = line.points[(i + 1) % line.points.size()];
        area += (a.x * b.y - b.x * a.y) / 2;
        length += distance(a, b);
    }
    const double least = std::numbers::pi * 4 * smoothing.value * smoothing.value;
    return std::abs(area) < std::max(least, length * smoothing.value / 2);
}

}  // namespace

std::vector<ContourLine> contours(const CoverageMap& map, Dbm level, Meters smoothing) {
    if (!positive.contains(smoothing.value)) {
        throw_out_of_range("contours", "smoothing", positive.text, smoothing.value);
    }
    const Grid along = smoothed(excess(map, level), smoothing.value / map.cell_width, true);
    const Grid field = smoothed(along, smoothing.value / map.cell_height, false);
    std::vector<ContourLine> lines = Tracer(field, map).lines();
    std::erase_if(lines, [&](const ContourLine& l) { return l.closed && is_speck(l, smoothing); });
    return lines;
}

}  // namespace rovernet
