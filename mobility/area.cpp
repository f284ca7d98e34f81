// SPDX-License-Identifier: MIT
#include "mobility/area.hpp"

#include "scene/scene.hpp"
#include "sim/math.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace rovernet {
namespace {

constexpr int most_draws = 10'000;
constexpr double turn = 6.283185307179586;  // [rad]

[[noreturn]] void refuse(std::string_view model, std::string_view why) {
    throw std::invalid_argument(fmt::format("{}: {}", model, why));
}

std::string text(Vec3 lower, Vec3 upper) {
    return fmt::format("({}, {}) to ({}, {}) m", lower.x, lower.y, upper.x, upper.y);
}

bool has_room(const Mover& mover, Vec3 p) {
    const Scene& scene = mover.scene();
    return scene.inside_map(p) && scene.passable(p, p, mover.radius);
}

/// Factor on `direction` for reaching the border in one coordinate; infinity if it is never
/// reached.
double exit_length(double x, double along, double lower, double upper) {
    if (along == 0) return std::numeric_limits<double>::infinity();
    return ((along > 0 ? upper : lower) - x) / along;
}

}  // namespace

Area::Area(const std::vector<Vec3>& corners, const Scene& scene, std::string_view model)
    : lower(scene.lower_left()), upper(scene.upper_right()) {
    if (corners.empty()) {
        if (scene.open_field())
            refuse(model,
                   "the key \"area\" must be given, because the scene is an open field without a "
                   "map; write area = [[x, y], [x, y]]");
        return;
    }
    if (corners.size() != 2) {
        refuse(model, fmt::format(
                          "\"area\" must be two corners, lower-left and upper-right, got {} points",
                          corners.size()));
    }
    const Vec3 a = corners[0], b = corners[1];
    const bool finite = any.contains(b.x - a.x) && any.contains(b.y - a.y);
    if (!finite || !(b.x > a.x) || !(b.y > a.y)) {
        refuse(model,
               "the second corner of the area must lie to the right of the first corner and above "
               "it, got " +
                   text(a, b));
    }
    const bool map = scene.has_border();
    if (map && !(std::max(a.x, lower.x) < std::min(b.x, upper.x) &&
                 std::max(a.y, lower.y) < std::min(b.y, upper.y))) {
        refuse(model, fmt::format("the area from {} does not overlap the map, which goes from {}",
                                  text(a, b), text(lower, upper)));
    }
    lower = map ? Vec3{std::max(a.x, lower.x), std::max(a.y, lower.y)} : a;
    upper = map ? Vec3{std::min(b.x, upper.x), std::min(b.y, upper.y)} : b;
}

double Area::diagonal() const {
    const Vec3 across = upper - lower;
    return std::sqrt(across.x * across.x + across.y * across.y);
}

double Area::shorter_side() const { return std::min(upper.x - lower.x, upper.y - lower.y); }

double Area::to_border(Vec3 p) const {
    return std::min({p.x - lower.x, upper.x - p.x, p.y - lower.y, upper.y - p.y});
}

Vec3 Area::clamped(Vec3 p) const {
    return {std::clamp(p.x, lower.x, upper.x), std::clamp(p.y, lower.y, upper.y), p.z};
}

Vec3 Area::exit(Vec3 p, Vec3 direction) const {
    const double right = exit_length(p.x, direction.x, lower.x, upper.x);
    const double up = exit_length(p.y, direction.y, lower.y, upper.y);
    Vec3 border = p + std::min(right, up) * direction;
    if (right <= up) border.x = direction.x > 0 ? upper.x : lower.x;
    if (up <= right) border.y = direction.y > 0 ? upper.y : lower.y;
    return clamped(border);
}

std::optional<Vec3> Area::free_place(const Mover& mover, Draws& draws) const {
    for (int i = 0; i < most_draws; ++i) {
        const double x = lower.x + draws.uniform(mover) * (upper.x - lower.x);
        const double y = lower.y + draws.uniform(mover) * (upper.y - lower.y);
        const Vec3 place = clamped({x, y, mover.position.z});
        if (has_room(mover, place)) return place;
    }
    return std::nullopt;
}

std::optional<Vec3> Area::first_place(const Mover& mover, StartPlace start, Draws& draws,
                                      std::string_view model) const {
    if (start == StartPlace::uniform && mover.now == start_of_run) return free_place(mover, draws);
    const Vec3 p = mover.position;
    if (contains(p)) return p;
    refuse(model, fmt::format("the robot must begin inside the area from {}, but is at ({}, {}) m",
                              text(lower, upper), p.x, p.y));
}

Vec3 straight_stop(const Mover& mover, Vec3 to) {
    const Scene& scene = mover.scene();
    const Vec3 from = mover.position;
    const auto at = [&](double share) { return share == 1 ? to : from + share * (to - from); };
    const auto open = [&](double share) {
        const Vec3 p = at(share);
        return scene.inside_map(p) && scene.passable(from, p, mover.radius);
    };
    return at(free_share(open, least_leg / distance(from, to)));
}

Vec3 direction_of(double angle) {
    const auto [sin, cos] = math::sincos(angle);
    return {cos, sin, 0};
}

Vec3 any_direction(const Mover& mover, Draws& draws) {
    return direction_of(turn * draws.uniform(mover));
}

}  // namespace rovernet
