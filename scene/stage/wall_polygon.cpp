// SPDX-License-Identifier: MIT
#include "scene/stage/wall_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace rovernet {
namespace {

/// Properties of one entity by name; the last of several with one name.
using Properties = std::map<std::string_view, const WorldProperty*>;

Properties properties_of(const WorldEntity& entity) {
    Properties out;
    for (const auto& property : entity.properties) out[property.name] = &property;
    return out;
}

int count(const WorldProperty& property) {
    const double number = property.number();
    constexpr double most = 1e6;
    if (number >= 0 && number <= most && number == std::floor(number)) {
        return static_cast<int>(number);
    }
    throw InputError(
        property.where,
        fmt::format(
            "{}: found {}; expected a whole number from 0 to 1000000; write the number of points",
            property.name, number));
}

Vec3 point(const WorldProperty& property) {
    const auto& v = property.values;
    if (property.is_tuple && v.size() == 2) {
        const double* x = std::get_if<double>(&v[0]);
        const double* y = std::get_if<double>(&v[1]);
        constexpr double largest_coordinate = 1e9;
        if (x && y && std::abs(*x) <= largest_coordinate && std::abs(*y) <= largest_coordinate)
            return {*x, *y, 0};
    }
    throw InputError(property.where, fmt::format("{}: expected two numbers [x y], at most 1e9; "
                                                 "write {} [0.1 0.2]",
                                                 property.name, property.name));
}

/// Outline under `prefix`: its keys are PREFIXpoints and PREFIXpoint[0] and so on.
WallPolygon outline(const Properties& properties, const std::string& prefix,
                    const Location& where) {
    const auto points = properties.find(prefix + "points");
    if (points == properties.end()) {
        throw InputError(where, fmt::format("the key \"{0}points\" is missing; expected the number "
                                            "of points; write {0}points 4",
                                            prefix));
    }
    WallPolygon polygon{.points = {}, .where = points->second->where};
    const int n = count(*points->second);
    for (int i = 0; i < n; ++i) {
        const auto found = properties.find(fmt::format("{}point[{}]", prefix, i));
        if (found == properties.end()) {
            throw InputError(
                polygon.where,
                fmt::format("{0}points: found no {0}point[{1}]; expected {2} points from "
                            "{0}point[0] on; add this point or correct the number",
                            prefix, i, n));
        }
        polygon.points.push_back(point(*found->second));
    }
    if (polygon.points.size() > 1 && polygon.points.front() == polygon.points.back()) {
        polygon.points.pop_back();
    }
    return polygon;
}

/// Intersections of the outline with the line at height y, ascending.
void crossings(const std::vector<Vec3>& points, double y, std::vector<double>& out) {
    out.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
        Vec3 a = points[i];
        Vec3 b = points[(i + 1) % points.size()];
        if (a.y > b.y) std::swap(a, b);
        if (!(a.y <= y && y < b.y)) continue;
        out.push_back(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    std::sort(out.begin(), out.end());
}

double cells_along(double length, double cell) {
    constexpr double roundings = 1e-9;  // 0.2 m are ten cells of 0.02 m
    return std::max(1.0, std::ceil(length / cell - roundings));
}

}  // namespace

bool WallPolygon::is_box() const {
    if (points.size() != 4) return false;
    const Extent e = extent_of(points);
    bool turns = true;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 a = points[i];
        const Vec3 b = points[(i + 1) % 4];
        const Vec3 c = points[(i + 2) % 4];
        turns = turns && ((a.x == b.x && b.y == c.y) || (a.y == b.y && b.x == c.x));
    }
    return turns && e.x1 > e.x0 && e.y1 > e.y0 && points[0] != points[2];
}

std::vector<WallPolygon> wall_polygons(const WorldEntity& entity) {
    std::vector<WallPolygon> out;
    Properties properties;
    for (const std::string kind : {"polygon", "block"}) {
        const WorldProperty* number = entity.find(kind + "s");
        if (!number) continue;
        if (properties.empty()) properties = properties_of(entity);
        const int n = count(*number);
        for (int i = 0; i < n; ++i) {
            out.push_back(outline(properties, fmt::format("{}[{}].", kind, i), number->where));
        }
    }
    for (const auto& child : entity.children) {
        if (child.type == "block") out.push_back(outline(properties_of(child), "", child.where));
    }
    return out;
}

Extent extent_of(const std::vector<Vec3>& points) {
    if (points.empty()) return {};
    Extent e{points[0].x, points[0].y, points[0].x, points[0].y};
    for (const Vec3 p : points) {
        e = {std::min(e.x0, p.x), std::min(e.y0, p.y), std::max(e.x1, p.x), std::max(e.y1, p.y)};
    }
    return e;
}

bool fit(std::vector<WallPolygon>& polygons, const WorldSize& size) {
    std::vector<Vec3> all;
    for (const auto& polygon : polygons) {
        all.insert(all.end(), polygon.points.begin(), polygon.points.end());
    }
    const Extent e = extent_of(all);
    if (!(e.x1 > e.x0 && e.y1 > e.y0)) return false;
    for (auto& polygon : polygons) {
        for (Vec3& p : polygon.points) {
            p.x = ((p.x - e.x0) / (e.x1 - e.x0) - 0.5) * size.x;
            p.y = ((p.y - e.y0) / (e.y1 - e.y0) - 0.5) * size.y;
        }
    }
    return true;
}

double filling_work(const WallPolygon& polygon, double cell) {
    if (polygon.is_box()) return 1;
    const Extent e = extent_of(polygon.points);
    const double rows = cells_along(e.y1 - e.y0, cell);
    return rows * (cells_along(e.x1 - e.x0, cell) + static_cast<double>(polygon.points.size()));
}

OccupancyGrid filled(const WallPolygon& polygon, double cell) {
    const Extent e = extent_of(polygon.points);
    const bool box = polygon.is_box();
    OccupancyGrid grid;
    grid.columns = box ? 1 : static_cast<int>(cells_along(e.x1 - e.x0, cell));
    grid.rows = box ? 1 : static_cast<int>(cells_along(e.y1 - e.y0, cell));
    grid.cell_width = (e.x1 - e.x0) / grid.columns;
    grid.cell_height = (e.y1 - e.y0) / grid.rows;
    grid.origin = {e.x0, e.y0, 0};
    std::vector<double> at;
    for (int row = 0; row < grid.rows; ++row) {
        crossings(polygon.points, e.y0 + (row + 0.5) * grid.cell_height, at);
        std::size_t passed = 0;
        for (int column = 0; column < grid.columns; ++column) {
            const double x = e.x0 + (column + 0.5) * grid.cell_width;
            while (passed < at.size() && at[passed] <= x) ++passed;
            grid.cells.push_back(passed % 2 == 1 ? Cell::occupied : Cell::free);
        }
    }
    return grid;
}

}  // namespace rovernet
