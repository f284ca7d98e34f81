// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_style.hpp"

#include <array>

namespace rovernet {
namespace {

constexpr std::array dashes{std::array<double, 4>{}, std::array<double, 4>{8, 3, 8, 3},
                            std::array<double, 4>{2.5, 2.5, 2.5, 2.5},
                            std::array<double, 4>{9, 2.5, 2.5, 2.5}};

// Corners that enclose about the same area; eight corners look round at this size.
constexpr PicturePoint disc[] = {{1, 0},  {0.71, 0.71},   {0, 1},  {-0.71, 0.71},
                                 {-1, 0}, {-0.71, -0.71}, {0, -1}, {0.71, -0.71}};
constexpr PicturePoint square[] = {{0.87, 0.87}, {-0.87, 0.87}, {-0.87, -0.87}, {0.87, -0.87}};
constexpr PicturePoint triangle[] = {{0, -1.3}, {1.2, 0.85}, {-1.2, 0.85}};
constexpr PicturePoint diamond[] = {{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}};
constexpr PicturePoint down[] = {{0, 1.3}, {1.2, -0.85}, {-1.2, -0.85}};
constexpr PicturePoint cross[] = {{0.45, -1.3}, {0.45, -0.45}, {1.3, -0.45},   {1.3, 0.45},
                                  {0.45, 0.45}, {0.45, 1.3},   {-0.45, 1.3},   {-0.45, 0.45},
                                  {-1.3, 0.45}, {-1.3, -0.45}, {-0.45, -0.45}, {-0.45, -1.3}};
constexpr std::array<ChartMarker, 6> markers{
    {{7, disc}, {5, square}, {9, triangle}, {13, diamond}, {11, down}, {1, cross}}};

}  // namespace

void ChartMarker::append_to(SvgPath& path, PicturePoint centre, double radius) const {
    bool first = true;
    for (const PicturePoint corner : corners) {
        const double x = centre.x + radius * corner.x, y = centre.y + radius * corner.y;
        first ? path.move(x, y) : path.line(x, y);
        first = false;
    }
    path.close();
}

std::string ChartStyle::dash_text() const {
    std::string out;
    for (const double length : dashes) out += (out.empty() ? "" : " ") + svg_number(length);
    return out.empty() ? "none" : out;
}

ChartStyle chart_style(std::size_t series) {
    const auto& d = dashes[series % dashes.size()];
    ChartStyle out{category_color(series), {}, markers[series % markers.size()]};
    if (d[0] > 0) out.dashes.assign(d.begin(), d.end());
    return out;
}

ChartStyle style_in(const Chart& chart, std::size_t series) {
    const auto& beside = chart.series[series].beside;
    ChartStyle style = chart_style(beside.value_or(series));
    style.hollow = beside.has_value();
    return style;
}

}  // namespace rovernet
