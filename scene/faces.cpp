// SPDX-License-Identifier: MIT
#include "scene/faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace rovernet {
namespace {

using Point = std::array<double, 2>;  // [m], in the map's own axes

Point on_line_of(const OutlineSide& side, Point p) {
    const double t =
        (p[0] - side.point[0]) * side.direction[0] + (p[1] - side.point[1]) * side.direction[1];
    return {side.point[0] + t * side.direction[0], side.point[1] + t * side.direction[1]};
}

bool near(Point p, Point q, double within) {
    const double dx = p[0] - q[0], dy = p[1] - q[1];
    return dx * dx + dy * dy <= within * within;
}

/// Intersection of the lines of two sides; empty if they are parallel.
std::optional<Point> meeting(const OutlineSide& a, const OutlineSide& b) {
    const double cross = a.direction[0] * b.direction[1] - a.direction[1] * b.direction[0];
    if (std::abs(cross) < 1e-6) return std::nullopt;
    const double t =
        ((b.point[0] - a.point[0]) * b.direction[1] - (b.point[1] - a.point[1]) * b.direction[0]) /
        cross;
    return Point{a.point[0] + t * a.direction[0], a.point[1] + t * a.direction[1]};
}

/// End of one side and start of the next, both near the corner of the outline between them.
std::pair<Point, Point> joint(const OutlineSide& a, const OutlineSide& b, Point corner,
                              double cell) {
    if (a.deviation == 0 && b.deviation == 0) return {corner, corner};
    constexpr double farthest = 1.5;  // [cells]
    const auto meet = meeting(a, b);
    if (meet && near(*meet, corner, farthest * cell)) return {*meet, *meet};
    return {on_line_of(a, corner), on_line_of(b, corner)};
}

/// Materials of a map's cells; -1 for cells that are not walls.
class CellMaterials {
  public:
    explicit CellMaterials(std::span<const WallsOfMap> walls)
        : columns_(walls.front().walls->columns()),
          rows_(walls.front().walls->rows()),
          cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1) {
        for (const WallsOfMap& layer : walls)
            for (int row = 0; row < rows_; ++row)
                for (int column = 0; column < columns_; ++column)
                    if (layer.walls->solid(column, row))
                        cells_[number(column, row)] = static_cast<std::int16_t>(layer.material);
    }
    int operator()(int column, int row) const {
        const bool inside = column >= 0 && column < columns_ && row >= 0 && row < rows_;
        return inside ? cells_[number(column, row)] : -1;
    }

  private:
    std::size_t number(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    int columns_, rows_;
    std::vector<std::int16_t> cells_;
};

}  // namespace

const Faces::Made& Faces::made() const {
    once_([this] { make(); });
    return made_;
}

void Faces::make() const {
    for (std::size_t i = 0; i < walls_.size();) {
        std::size_t end = i;
        while (end < walls_.size() && walls_[end].map == walls_[i].map) ++end;
        add_map(std::span(walls_).subspan(i, end - i));
        i = end;
    }
    for (Face& face : made_.faces) measure(face);
    made_.any_stair = std::any_of(made_.faces.begin(), made_.faces.end(),
                                  [](const Face& face) { return face.deviation > 0; });
}

void Faces::measure(Face& face) const {
    for (const WallsOfMap& layer : walls_)
        if (layer.material == face.material) face.height = layer.height;
    std::array<double, 3> ways{thickness(face, 0.25), thickness(face, 0.5), thickness(face, 0.75)};
    std::sort(ways.begin(), ways.end());
    face.thickness = ways[1];
}

/// Length of the path through the wall behind one point of the face [m].
double Faces::thickness(const Face& face, double along) const {
    constexpr double farthest = 5;  // [m]
    const Vec3 on_face = face.from + along * (face.to - face.from);
    // From a point in front of the drawn outline, which may lie on both sides of the line.
    const Vec3 begin = on_face + (face.deviation + 1e-6) * face.normal;
    const Vec3 end = on_face - farthest * face.normal;
    const double length = distance(begin, end);
    std::vector<Crossing> crossings;
    for (const WallsOfMap& layer : walls_) {
        if (layer.material != face.material) continue;
        layer.walls->crossings(layer.frame.to_cells(begin), layer.frame.to_cells(end), length,
                               crossings);
        if (crossings.empty() || crossings[0].entry > 2 * face.deviation + 2e-6) continue;
        const Vec3 exit = begin + (crossings[0].exit / length) * (end - begin);
        const auto other = find(exit, face.material);
        if (other && face.opposite(made_.faces[*other]))
            return std::max(0.0, -made_.faces[*other].in_front(on_face));
        return crossings[0].length;
    }
    return 0;
}

void Faces::add_map(std::span<const WallsOfMap> walls) const {
    const MapFrame& frame = walls.front().frame;
    const CellMaterials material(walls);
    const int columns = walls.front().walls->columns(), rows = walls.front().walls->rows();
    Lines lines{frame, columns, rows};
    for (const Outline& outline : outlines(columns, rows, material)) {
        const auto sides = straight_sides(outline, frame.cell_width(), frame.cell_height());
        const std::size_t first_face = made_.faces.size();
        add_outline(outline, sides, frame);
        for (std::size_t s = 0; s < sides.size(); ++s) {
            for (std::size_t i = 0; i < sides[s].count; ++i) {
                const OutlineEdge& e = outline[(sides[s].first + i) % outline.size()];
                const bool upright = e.u0 == e.u1;
                const auto [low, high] =
                    upright ? std::minmax(e.v0, e.v1) : std::minmax(e.u0, e.u1);
                lines.runs.push_back(
                    {lines.number(upright, upright ? e.u0 : e.v0, low), high, first_face + s});
            }
        }
    }
    std::sort(lines.runs.begin(), lines.runs.end(),
              [](const Run& a, const Run& b) { return a.edge < b.edge; });
    std::vector<std::size_t> begins;
    for (const Run& run : lines.runs) begins.push_back(run.edge);
    lines.begins = CountedBits(lines.number(false, rows, columns), begins);
    made_.maps.push_back(std::move(lines));
}

void Faces::add_outline(const Outline& outline, const std::vector<OutlineSide>& sides,
                        const MapFrame& frame) const {
    const std::size_t number = made_.faces.empty() ? 0 : made_.faces.back().outline + 1;
    const double width = frame.cell_width(), height = frame.cell_height();
    std::vector<std::pair<Point, Point>> joints;  // between a side and the one before
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const OutlineEdge& e = outline[sides[s].first % outline.size()];
        joints.push_back(joint(sides[(s + sides.size() - 1) % sides.size()], sides[s],
                               {e.u0 * width, e.v0 * height}, std::max(width, height)));
    }
    const auto world = [&](Point p) { return frame.to_world({p[0] / width, p[1] / height}); };
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const auto& d = sides[s].direction;
        const Point begin = joints[s].second, end = joints[(s + 1) % sides.size()].first;
        const double along = (end[0] - begin[0]) * d[0] + (end[1] - begin[1]) * d[1];
        const OutlineEdge& first = outline[sides[s].first % outline.size()];
        const OutlineEdge& last = outline[(sides[s].first + sides[s].count - 1) % outline.size()];
        const Vec3 out = frame.to_world({d[1] / width, -d[0] / height}) - frame.to_world({0, 0});
        made_.faces.push_back(
            {.from = world(begin),
             .to = along > 0 ? world(end) : world(begin),
             .normal = out,
             .length = std::max(along, 0.0),
             .deviation = sides[s].deviation,
             .slants = std::min(std::abs(last.u1 - first.u0), std::abs(last.v1 - first.v0)) >= 2,
             .material = first.material,
             .outline = number});
    }
}

std::size_t Faces::Lines::number(bool upright, int line, int along) const {
    const auto u = static_cast<std::size_t>(columns), v = static_cast<std::size_t>(rows);
    const auto i = static_cast<std::size_t>(line), k = static_cast<std::size_t>(along);
    return (upright ? 0 : (u + 1) * v) + i * (upright ? v : u) + k;
}

std::optional<std::size_t> Faces::on_line(const Lines& map, bool upright, int line, double along,
                                          std::size_t material) const {
    constexpr double tolerance = 1e-6;  // [cells]
    if (along + tolerance < 0) return std::nullopt;
    const double last = (upright ? map.rows : map.columns) - 1;
    const int edge = static_cast<int>(std::min(along + tolerance, last));
    const std::size_t first = map.begins.below(map.number(upright, line, 0));
    // Start with the last run that begins before the point, or the one before, if they touch there.
    std::size_t i = map.begins.below(map.number(upright, line, edge) + 1);
    for (int tries = 0; tries < 2 && i != first; ++tries) {
        const Run& run = map.runs[--i];
        if (run.end < along - tolerance) break;
        if (made_.faces[run.face].material == material) return run.face;
    }
    return std::nullopt;
}

std::optional<std::size_t> Faces::at(Vec3 p, std::size_t material) const {
    made();
    return find(p, material);
}

std::optional<std::size_t> Faces::find(Vec3 p, std::size_t material) const {
    constexpr double tolerance = 1e-6;  // [cells]
    for (const Lines& map : made_.maps) {
        const CellPoint c = map.frame.to_cells(p);
        const double u = std::floor(c.u + 0.5), v = std::floor(c.v + 0.5);
        const double off_u = std::abs(c.u - u), off_v = std::abs(c.v - v);
        // Indexed by direction, horizontal and vertical, without branches, which would be
        // mispredicted.
        const std::array<double, 2> line{v, u}, off{off_v, off_u}, along{c.u, c.v};
        const std::array<int, 2> last{map.rows, map.columns};
        const auto on = [&](bool upright) -> std::optional<std::size_t> {
            if (off[upright] > tolerance || line[upright] < 0 || line[upright] > last[upright])
                return std::nullopt;
            return on_line(map, upright, static_cast<int>(line[upright]), along[upright], material);
        };
        const bool upright_first = off_u <= off_v;
        auto found = on(upright_first);
        if (!found) found = on(!upright_first);
        if (found) return found;
    }
    return std::nullopt;
}

}  // namespace rovernet
