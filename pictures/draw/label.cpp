// SPDX-License-Identifier: MIT
#include "pictures/draw/label.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rovernet {
namespace {

constexpr double tile_size = 48;  // [px]
constexpr double gap = 3;         // [px] between a disc and its label

std::size_t tiles(double size) {
    return static_cast<std::size_t>(std::clamp(std::ceil(size / tile_size), 1.0, 1000.0));
}

std::size_t tile_of(double place, std::size_t count) {
    const double last = static_cast<double>(count - 1);
    return static_cast<std::size_t>(std::clamp(std::floor(place / tile_size), 0.0, last));
}

}  // namespace

LabelPlaces::LabelPlaces(const Box& area)
    : area_(area),
      columns_(tiles(area.right - area.left)),
      rows_(tiles(area.bottom - area.top)),
      tiles_(columns_ * rows_) {}

template <class Visit>
void LabelPlaces::for_each_tile(const Box& box, Visit visit) const {
    const std::size_t last_column = tile_of(box.right - area_.left, columns_);
    const std::size_t last_row = tile_of(box.bottom - area_.top, rows_);
    for (std::size_t row = tile_of(box.top - area_.top, rows_); row <= last_row; ++row) {
        for (std::size_t c = tile_of(box.left - area_.left, columns_); c <= last_column; ++c) {
            visit(row * columns_ + c);
        }
    }
}

void LabelPlaces::keep_free(const Box& box) {
    for_each_tile(box, [&](std::size_t tile) { tiles_[tile].taken.push_back(box); });
}

bool LabelPlaces::free(const Box& box) const {
    bool found = false;
    for_each_tile(box, [&](std::size_t tile) {
        found = found || std::any_of(tiles_[tile].taken.begin(), tiles_[tile].taken.end(),
                                     [&](const Box& b) { return b.overlaps(box); });
    });
    return !found;
}

void LabelPlaces::avoid(PicturePoint from, PicturePoint to) {
    constexpr double step = 4;  // [px] between the points of a line
    const double dx = to.x - from.x, dy = to.y - from.y;
    const double steps = std::min(std::ceil(std::sqrt(dx * dx + dy * dy) / step), 10'000.0);
    for (double i = 0; i <= steps; ++i) {
        const double share = steps > 0 ? i / steps : 0;
        const PicturePoint p{from.x + share * dx, from.y + share * dy};
        for_each_tile({p.x, p.y, p.x, p.y},
                      [&](std::size_t tile) { tiles_[tile].lines.push_back(p); });
    }
}

std::size_t LabelPlaces::points_of_lines(const Box& box) const {
    std::size_t count = 0;
    for_each_tile(box, [&](std::size_t tile) {
        for (const PicturePoint p : tiles_[tile].lines) {
            count += p.x >= box.left && p.x <= box.right && p.y >= box.top && p.y <= box.bottom;
        }
    });
    return count;
}

std::optional<Box> LabelPlaces::place(PicturePoint centre, double radius, double width,
                                      double height) {
    constexpr double diagonal = 0.7;
    const double side = radius + gap, corner = diagonal * radius + gap;
    const double across = side + width / 2, along = side + height / 2;
    const double x = corner + width / 2, y = corner + height / 2;
    std::optional<Box> best;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (const PicturePoint shift :
         {PicturePoint{across, 0}, PicturePoint{-across, 0}, PicturePoint{0, -along},
          PicturePoint{0, along}, PicturePoint{x, -y}, PicturePoint{x, y}, PicturePoint{-x, -y},
          PicturePoint{-x, y}}) {
        const double cx = centre.x + shift.x, cy = centre.y + shift.y;
        const Box box{cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2};
        if (!box.inside(area_) || !free(box)) continue;
        const std::size_t crossed = points_of_lines(box);
        if (crossed >= fewest) continue;
        fewest = crossed;
        best = box;
    }
    if (best) keep_free(*best);
    return best;
}

std::optional<Box> LabelPlaces::place_at_end(PicturePoint end, bool below, double width,
                                             double height) {
    constexpr int steps = 4;  // from the middle to a side
    const double top = below ? end.y + gap : end.y - gap - height;
    for (int n = 0; n <= 2 * steps; ++n) {
        const double aside = (n % 2 == 0 ? 1 : -1) * (n + 1) / 2;
        const double left = end.x - width / 2 + width / 2 * aside / steps;
        const Box box{left, top, left + width, top + height};
        if (!box.inside(area_) || !free(box)) continue;
        keep_free(box);
        return box;
    }
    return std::nullopt;
}

}  // namespace rovernet
