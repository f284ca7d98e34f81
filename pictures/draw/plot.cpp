// SPDX-License-Identifier: MIT
#include "pictures/draw/plot.hpp"

#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rovernet {

void Extent::include(Vec3 centre, double radius) {
    const Vec3 low = centre - Vec3{radius, radius, 0}, high = centre + Vec3{radius, radius, 0};
    if (!low_) {
        low_ = low;
        high_ = high;
    }
    low_ = {std::min(low_->x, low.x), std::min(low_->y, low.y), 0};
    high_ = {std::max(high_.x, high.x), std::max(high_.y, high.y), 0};
}

void Extent::grow(double x, double y) {
    low_ = low() - Vec3{x, y, 0};
    high_ = high_ + Vec3{x, y, 0};
}

Plot::Plot(const Extent& extent, PicturePoint corner, const Limits& limits)
    : left(corner.x), top(corner.y) {
    constexpr double least_size = 1e-3;  // [m] of the world
    Extent shown = extent;
    shown.grow(std::max(0.0, least_size - shown.width()) / 2,
               std::max(0.0, least_size - shown.height()) / 2);
    scale = std::min(limits.width / shown.width(), limits.height / shown.height());
    width = std::max(limits.least_width, shown.width() * scale);
    height = std::max(limits.least_height, shown.height() * scale);
    const Vec3 half{width / scale / 2, height / scale / 2, 0};
    low = shown.centre() - half;
    high = shown.centre() + half;
}

double round_number(double most) {
    const double decade = math::exp10(std::floor(math::log10(most)));
    for (const double digit : {5.0, 2.0}) {
        if (digit * decade <= most) return digit * decade;
    }
    return decade;
}

std::vector<double> round_ticks(double low, double high, int most) {
    std::vector<double> ticks;
    if (!(high > low)) return {low};
    double step = round_number((high - low) / most);
    while (std::floor(high / step) - std::ceil(low / step) + 1 > most) {
        step = round_number(step * 2.5);
    }
    for (double k = std::ceil(low / step); k * step <= high; ++k) ticks.push_back(k * step);
    return ticks;
}

std::string length_text(double metres) {
    if (metres >= 1000) return fmt::format("{:.6g} km", metres / 1000);
    if (metres >= 1) return fmt::format("{:.6g} m", metres);
    if (metres >= 0.01) return fmt::format("{:.6g} cm", metres * 100);
    return fmt::format("{:.6g} mm", metres * 1000);
}

}  // namespace rovernet
