// SPDX-License-Identifier: MIT
#include "pictures/map/map_layer.hpp"

#include "pictures/map/map_style.hpp"
#include "scene/rectangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace rovernet {
namespace {

constexpr Color unknown_color{0xe2, 0xe2, 0xe2};
constexpr double thin_line = 0.4;  // [px] around walls, so that the thinnest are seen
constexpr double seam = 1.6;       // [px] the same, of the white below them

std::string fill_of(std::size_t material) {
    const std::size_t style = material % wall_styles.size();
    return wall_styles[style].hatch ? fmt::format("url(#hatch{})", style)
                                    : hex(wall_styles[style].color);
}

void define_hatch(Svg& svg, std::size_t style) {
    svg.open("pattern", {{"id", fmt::format("hatch{}", style)},
                         {"width", hatch_size},
                         {"height", hatch_size},
                         {"patternUnits", "userSpaceOnUse"}});
    svg.add("rect", {{"width", hatch_size}, {"height", hatch_size}, {"fill", "#ffffff"}});
    svg.add("path", {{"d", wall_styles[style].hatch},
                     {"stroke", wall_styles[style].color},
                     {"stroke-width", 1.4},
                     {"fill", "none"}});
    svg.close();
}

std::string unknown_fill(bool on_colors) {
    return on_colors ? "url(#unknown)" : hex(unknown_color);
}

/// Draws what is defined under that id.
void use(Svg& svg, const std::string& id, const std::string& fill, Color stroke, double width) {
    svg.add(
        "use",
        {{"xlink:href", "#" + id}, {"fill", fill}, {"stroke", stroke}, {"stroke-width", width}});
}

/// Hatch lines, through which the colours below stay visible.
void define_unknown(Svg& svg) {
    svg.open("pattern", {{"id", "unknown"},
                         {"width", hatch_size},
                         {"height", hatch_size},
                         {"patternUnits", "userSpaceOnUse"}});
    svg.add("path", {{"d", "M-1 5L1 7M0 0L6 6M5 -1L7 1"},
                     {"stroke", unknown_color},
                     {"stroke-width", 1.0},
                     {"fill", "none"}});
    svg.close();
}

/// Rectangles as the data of paths, each short enough for readers that bound an attribute.
class RectanglePaths {
  public:
    explicit RectanglePaths(const Plot& plot) : plot_(plot) {}

    void add(const std::array<Vec3, 4>& corners);
    std::vector<std::string> finish();

  private:
    SvgPath& path();
    void add_upright(double left, double top, double right, double bottom);

    const Plot& plot_;
    std::vector<std::string> done_;
    SvgPath path_;
    std::vector<std::pair<int, int>> crumbs_;  // tiles of rectangles that are too small to be seen
};

constexpr double crumb = 0.5;  // [px] size of such a tile

SvgPath& RectanglePaths::path() {
    constexpr std::size_t longest = 1'000'000;
    if (path_.text().size() > longest) done_.push_back(std::exchange(path_, SvgPath{}).text());
    return path_;
}

void RectanglePaths::add_upright(double left, double top, double right, double bottom) {
    path().move(left, top).horizontal(right).vertical(bottom).horizontal(left).close();
}

void RectanglePaths::add(const std::array<Vec3, 4>& corners) {
    std::array<PicturePoint, 4> p{};
    std::transform(corners.begin(), corners.end(), p.begin(), [&](Vec3 c) { return plot_.at(c); });
    const auto [x0, x1] = std::minmax({p[0].x, p[1].x, p[2].x, p[3].x});
    const auto [y0, y1] = std::minmax({p[0].y, p[1].y, p[2].y, p[3].y});
    if (x1 - x0 < crumb && y1 - y0 < crumb) {
        crumbs_.emplace_back(static_cast<int>(std::floor((y0 - plot_.top) / crumb)),
                             static_cast<int>(std::floor((x0 - plot_.left) / crumb)));
    } else if (corners[0].y == corners[1].y && corners[1].x == corners[2].x) {
        add_upright(x0, y0, x1, y1);
    } else {
        path().move(p[0].x, p[0].y).line(p[1].x, p[1].y).line(p[2].x, p[2].y);
        path_.line(p[3].x, p[3].y).close();
    }
}

std::vector<std::string> RectanglePaths::finish() {
    std::sort(crumbs_.begin(), crumbs_.end());
    crumbs_.erase(std::unique(crumbs_.begin(), crumbs_.end()), crumbs_.end());
    for (const auto& [row, column] : crumbs_) {
        const double x = plot_.left + column * crumb, y = plot_.top + row * crumb;
        add_upright(x, y, x + crumb, y + crumb);
    }
    if (!path_.empty()) done_.push_back(path_.text());
    return std::move(done_);
}

std::vector<std::string> paths_of(std::span<const std::array<Vec3, 4>> rectangles,
                                  const Plot& plot) {
    RectanglePaths paths(plot);
    for (const auto& corners : rectangles) paths.add(corners);
    return paths.finish();
}

std::vector<std::array<Vec3, 4>> unknown_rectangles(const Scene& scene) {
    OccupancyGrid grid = scene.grid();
    for (Cell& cell : grid.cells) cell = cell == Cell::unknown ? Cell::occupied : Cell::free;
    std::vector<std::array<Vec3, 4>> out;
    const MapFrame& frame = scene.frame();
    for (const auto& r : solid_rectangles(grid, Solid::walls)) {
        const double left = r.column0, right = r.column1, bottom = r.row0, top = r.row1;
        out.push_back({frame.to_world({left, bottom}), frame.to_world({right, bottom}),
                       frame.to_world({right, top}), frame.to_world({left, top})});
    }
    return out;
}

void draw_door(Svg& svg, const std::string& outline, bool closed) {
    svg.add("path", {{"d", outline},
                     {"fill", "none"},
                     {"stroke", door_color},
                     {"stroke-width", closed ? 1.6 : 1.0},
                     {"stroke-dasharray", closed ? "none" : "3 2"}});
}

void draw_stairs(Svg& svg, PicturePoint foot, PicturePoint head) {
    constexpr double rung = 7, apart = 5, tip = 6;  // [px]
    const double dx = head.x - foot.x, dy = head.y - foot.y;
    const double length = std::max(std::sqrt(dx * dx + dy * dy), 1e-9);
    const double ux = dx / length, uy = dy / length;
    SvgPath path;
    path.move(foot.x, foot.y).line(head.x, head.y);
    for (double at = apart; at < length - tip; at += apart) {
        const double x = foot.x + at * ux, y = foot.y + at * uy;
        path.move(x - rung / 2 * uy, y + rung / 2 * ux).line(x + rung / 2 * uy, y - rung / 2 * ux);
    }
    path.move(head.x - tip * ux - tip / 2 * uy, head.y - tip * uy + tip / 2 * ux);
    path.line(head.x, head.y);
    path.line(head.x - tip * ux + tip / 2 * uy, head.y - tip * uy - tip / 2 * ux);
    svg.add(
        "path",
        {{"d", path.text()}, {"fill", "none"}, {"stroke", stairs_color}, {"stroke-width", 1.0}});
}

LegendItem door_sample(std::string text, bool closed) {
    return {std::move(text), 18, [closed](Svg& svg, PicturePoint p) {
                SvgPath path;
                path.move(p.x, p.y - 3).horizontal(p.x + 18).vertical(p.y + 3).horizontal(p.x);
                draw_door(svg, path.close().text(), closed);
            }};
}

LegendItem swatch(std::string text, std::string fill) {
    return {std::move(text), 18, [fill = std::move(fill)](Svg& svg, PicturePoint p) {
                svg.add("rect", {{"x", p.x},
                                 {"y", p.y - 5},
                                 {"width", 18.0},
                                 {"height", 10.0},
                                 {"fill", fill},
                                 {"stroke", "#333333"},
                                 {"stroke-width", 0.8}});
            }};
}

}  // namespace

MapLayer::MapLayer(const Scene& scene, const Scene& open)
    : scene_(scene), walls_(scene.materials().size()) {
    if (scene.open_field()) return;
    for (const auto& rectangle : scene.wall_rectangles()) {
        walls_[rectangle.material].push_back(rectangle.corners);
    }
    unknown_ = unknown_rectangles(open);
}

void MapLayer::draw(Svg& svg, const Plot& plot, bool on_colors) const {
    svg.open("defs", {});
    if (!unknown_.empty() && on_colors) define_unknown(svg);
    for (std::size_t i = 0; i < std::min(walls_.size(), wall_styles.size()); ++i) {
        if (wall_styles[i].hatch && !walls_[i].empty()) define_hatch(svg, i);
    }
    std::vector<std::pair<std::string, std::size_t>> drawn;  // id and material of each path
    for (std::size_t material = 0; material < walls_.size(); ++material) {
        for (const auto& data : paths_of(walls_[material], plot)) {
            drawn.emplace_back(fmt::format("walls{}", drawn.size()), material);
            svg.add("path", {{"id", drawn.back().first}, {"d", data}});
        }
    }
    svg.close();
    for (const auto& data : paths_of(unknown_, plot)) {
        svg.add("path", {{"d", data}, {"fill", unknown_fill(on_colors)}});
    }
    for (const auto& path : drawn) {
        if (on_colors) use(svg, path.first, "none", Color{0xff, 0xff, 0xff}, seam);
    }
    for (const auto& path : drawn) {
        const Color edge = wall_styles[path.second % wall_styles.size()].color;
        use(svg, path.first, fill_of(path.second), edge, thin_line);
    }
    for (const auto& data : paths_of(open_doors_, plot)) draw_door(svg, data, false);
    for (const auto& data : paths_of(closed_doors_, plot)) draw_door(svg, data, true);
    for (const auto& [foot, head] : stairs_) draw_stairs(svg, plot.at(foot), plot.at(head));
}

void MapLayer::append_to(Legend& legend, bool on_colors) const {
    constexpr std::size_t most_listed = 12;
    constexpr std::size_t longest_name = 24;
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
        if (!walls_[i].empty()) used.push_back(i);
    }
    for (std::size_t n = 0; n < used.size() && used.size() > 1; ++n) {
        if (n == most_listed) {
            legend.add(swatch(fmt::format("and {} more materials", used.size() - n), "#ffffff"));
            break;
        }
        legend.add(
            swatch(shortened(scene_.materials()[used[n]].name, longest_name), fill_of(used[n])));
    }
    if (!unknown_.empty()) legend.add(swatch("unknown", unknown_fill(on_colors)));
    if (!open_doors_.empty()) legend.add(door_sample("open door", false));
    if (!closed_doors_.empty()) legend.add(door_sample("closed door", true));
    if (stairs_.empty()) return;
    legend.add({"stairs, up", 26, [](Svg& svg, PicturePoint p) {
                    draw_stairs(svg, p, {p.x + 26, p.y});
                }});
}

}  // namespace rovernet
