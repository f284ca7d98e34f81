// SPDX-License-Identifier: MIT
#include "models/propagation/multi_wall.hpp"
#include "models/propagation/propagation.hpp"
#include "scene/doors.hpp"
#include "scene/redrawing.hpp"
#include "scene/scene.hpp"
#include "sim/math.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/validation_charts.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

// How many walls, doors and floors lie on a link, against how many were drawn.

namespace rovernet {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;
constexpr double map_side = 14, thick = 0.15;  // [m] of the map, and of a wall

double loss_on(const MultiWall& model, const Scene& scene, Vec3 from, Vec3 to) {
    return Propagation(model).loss_to(
        to, {.frequency = Hertz{2450e6}, .from = from, .from_key = 1, .scene = &scene}, 2);
}

/// Walls beside one another in the middle of a map, at an angle to its cells.
struct SlantingWalls {
    double angle;   // [rad]
    int number;     // of walls
    double apart;   // [m] from the middle of one to that of the next
    bool outlined;  // instead of filled

    /// Point of the map by its place along and across the walls [m].
    Vec3 point(double x, double y) const {
        const auto [sine, cosine] = math::sincos(angle);
        return {map_side / 2 + cosine * x - sine * y, map_side / 2 + sine * x + cosine * y, 1};
    }
    double depth() const { return thick + (number - 1) * apart; }
    bool is_wall(Vec3 p) const {
        const auto [sine, cosine] = math::sincos(angle);
        const double x = cosine * (p.x - map_side / 2) + sine * (p.y - map_side / 2);
        const double y = cosine * (p.y - map_side / 2) - sine * (p.x - map_side / 2) + depth() / 2;
        const double beside = y - apart * std::floor(y / apart);
        return std::abs(x) <= 5.5 && y >= 0 && y < depth() && (number == 1 || beside < thick);
    }
    Scene drawn(double cell) const {
        const OccupancyGrid map =
            drawn_map(map_side, map_side, cell, [&](Vec3 p) { return is_wall(p); });
        return Scene(outlined ? outline_walls(map) : map);
    }
};

/// Greatest difference between the walls on links and those drawn.
double worst_count(const SlantingWalls& walls, double cell, std::size_t& n) {
    constexpr std::array grazing{90.0, 45.0, 20.0, 10.0, 6.0, 4.0, 2.0};
    const MultiWall counting{.light_wall = Db{1}, .heavy_wall = Db{1}};
    const Scene scene = walls.drawn(cell);
    double worst = 0;
    for (std::size_t i = 0; i < grazing.size(); ++i) {
        const auto [sine, cosine] = math::sincos(grazing[i] * radians_per_degree);
        const double half = (walls.depth() / 2 + 0.12) / sine;
        if (half * cosine > 5) continue;  // longer than the walls
        for (std::uint64_t k = 0; k < 5; ++k) {
            const double x = 0.4 * (validation_draw("wall counts", i, k) - 0.5);
            const Vec3 a = walls.point(x - half * cosine, -half * sine);
            const Vec3 b = walls.point(x + half * cosine, half * sine);
            const double found = loss_on(counting, scene, a, b) - loss_on(counting, Scene(), a, b);
            worst = std::max(worst, std::abs(std::round(found) - walls.number));
            ++n;
        }
    }
    return worst;
}

Promise wall_counts() {
    Promise out{
        "number of walls that a link crosses (walls drawn at 15 angles, links at 2 to 90 degrees "
        "to the walls), against the number of drawn walls",
        "", 0, 0, 0};
    for (const double angle :
         {0.0, 1.0, 3.0, 7.0, 12.0, 20.0, 26.565, 33.0, 40.0, 45.0, 52.0, 61.0, 70.0, 83.0, 89.5}) {
        const auto look = [&](const SlantingWalls& walls, double cell) {
            out.worst = std::max(out.worst, worst_count(walls, cell, out.n));
        };
        for (const double cell : {0.02, 0.05, 0.1})
            look({angle * radians_per_degree, 1, 1, false}, cell);
        for (const double cell : {0.02, 0.05}) {
            look({angle * radians_per_degree, 1, 1, true}, cell);
            look({angle * radians_per_degree, 2, 0.3, false}, cell);
        }
    }
    return out;
}

/// Storeys of 3 m, each with a wall of 20 cm across x = 5 that has a door.
Scene storeys(std::size_t number, const std::vector<Material>& ceilings) {
    std::vector<OccupancyGrid> maps;
    for (std::size_t i = 0; i < number; ++i) {
        maps.push_back(drawn_map(
            10, 6, 0.1, [](Vec3 p) { return p.x > 5 && p.x < 5.2 && !(p.y > 2 && p.y < 3); }));
        maps.back().origin.z = 3 * static_cast<double>(i);
    }
    return Scene(std::move(maps), {Material{}}, ceilings);
}

Promise doors_and_storeys() {
    constexpr double limit = 1e-9;  // [dB]
    Promise out{"loss of doors and storeys on a link, against their losses added up by hand", "dB",
                limit, 0, 0};
    const auto check = [&](const Scene& scene, Vec3 a, Vec3 b, double truth) {
        out.add(loss_on({}, scene, a, b) - loss_on({}, Scene(), a, b) - truth);
    };
    const Vec3 here{1, 2.5, 1}, there{9, 2.5, 1}, beside{1, 4.5, 1}, across{9, 4.5, 1};
    const auto up = [](Vec3 p, double storeys) { return p + Vec3{0, 0, 3 * storeys}; };
    const auto house = std::make_shared<const Scene>(storeys(4, {}));
    check(*house, here, there, 0);
    check(*house, beside, across, 6.9);
    for (const auto& [floors, loss] :
         {std::pair{1, 18.3}, {2, 33.5235976238911}, {3, 43.58899751322817}})
        check(*house, here, up(there, floors), loss);
    const Scene slabs =
        storeys(3, {Material{.per_crossing = Db{15}}, Material{.per_crossing = Db{9}}});
    check(slabs, here, up(there, 1), 15);
    check(slabs, here, up(there, 2), 24);
    check(slabs, up(here, 2), up(there, 1), 9);
    using namespace std::chrono_literals;
    const Door steel{.from = {5.1, 2, 3},
                     .to = {5.1, 3, 3},
                     .material = {.name = "steel", .per_crossing = Db{21}},
                     .closes = {10s},
                     .opens = {20s}};
    const Door wood{.from = {5.1, 2, 0}, .to = {5.1, 3, 0}, .closes = {15s}};
    const auto changes = scene_changes(house, std::vector{steel, wood});
    const auto at = [&](Duration t) -> const Scene& {
        const SceneChange* change = last_change(changes, start_of_run + t);
        return change ? *change->scene : *house;
    };
    check(at(9s), up(here, 1), up(there, 1), 0);
    check(at(10s), up(here, 1), up(there, 1), 21);
    check(at(10s), here, there, 0);
    check(at(15s), here, there, 3.4);
    check(at(15s), up(here, 1), up(there, 1), 21);
    check(at(20s), up(here, 1), up(there, 1), 0);
    check(at(20s), beside, across, 6.9);
    return out;
}

}  // namespace

void check_counts(Promises& promises) {
    promises.push_back(wall_counts());
    promises.push_back(doors_and_storeys());
}

}  // namespace rovernet
