// SPDX-License-Identifier: MIT
#include "models/links/link_changes.hpp"
#include "models/propagation/list.hpp"
#include "test/models/links/moving_pair.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

namespace link_changes_walls_test {
using namespace rovernet;
using namespace std::chrono_literals;
using test::moving;
using test::MovingPair;
using test::random_leg;
using test::resting;

namespace {

constexpr NodeId a{0}, b{1};

/// A wall along y = 5 ... 5 + thickness with a gap of that width from x = 10 on, made of boxes.
Scene wall_with_gap(double gap, double thickness, const Material& material) {
    const auto part = [&](double left, double right) {
        return OccupancyGrid{.columns = 1,
                             .rows = 1,
                             .cell_width = right - left,
                             .cell_height = thickness,
                             .origin = {left, 5, 0},
                             .cells = {Cell::occupied}};
    };
    return Scene({part(-40, 10), part(10 + gap, 60)}, {material});
}

}  // namespace

TEST_CASE("link changes: a link through a narrow door is up while no corner is in the way") {
    constexpr Duration within = 3ns;  // rounding of the corner and of the times
    for (const double gap : {1.0, 0.1, 1e-5, 1e-7}) {
        CAPTURE(gap);
        const Scene scene = wall_with_gap(gap, 0.1, {.per_crossing = 200_dB});
        MovingPair pair{&scene};
        pair.add(Raytrace2007{}, resting({10, 10, 0}));
        pair.add(Raytrace2007{}, moving({0, 0, 0}, {5, 0, 0}, 4s));
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 4s);
        // From x = 10 to where the ray grazes the right post at half way: x = 10 + 2 gap.
        REQUIRE(found.size() == 2);
        const Duration open = from_seconds(2 * gap / 5);
        CHECK(std::chrono::abs(found[0] - (start_of_run + 2s)) <= within);
        CHECK(std::chrono::abs(found[1] - (start_of_run + 2s + open)) <= within);
        CHECK(pair.changes(b, a, start_of_run, start_of_run + 4s) == found);
    }
}

TEST_CASE(
    "link changes: over a wall of finite height, a link changes as the line of sight passes the "
    "top edge") {
    constexpr Duration within = 3ns;
    const Scene scene(OccupancyGrid{.columns = 1,
                                    .rows = 1,
                                    .cell_width = 0.1,
                                    .cell_height = 100,
                                    .origin = {10, -50, 0},
                                    .cells = {Cell::occupied}},
                      {{.per_crossing = 200_dB, .height = 2_m}});
    const Radio low{.antenna_height = 0_m};
    MovingPair pair{&scene};
    pair.add(Raytrace2007{}, resting({0, 0, 3}), low);
    pair.add(Raytrace2007{}, moving({12, 0, 1}, {4, 0, 0}, 10s), low);
    pair.add(Raytrace2007{}, moving({20, 0, 0}, {0, 0, 1}, 10s), low);
    // The ray falls from 3 m to 1 m; half way it is as high as the wall, whose far face is passed.
    const auto driving = pair.changes(a, b, start_of_run, start_of_run + 10s);
    REQUIRE(driving.size() == 1);
    CHECK(std::chrono::abs(driving[0] - (start_of_run + 2'050ms)) <= within);
    // Rising at 20 m: 3 + (z - 3) 10.1 / 20 = 2.
    const auto rising = pair.changes(a, NodeId{2}, start_of_run, start_of_run + 10s);
    REQUIRE(rising.size() == 1);
    CHECK(std::chrono::abs(rising[0] - (start_of_run + from_seconds(3 - 20 / 10.1))) <= within);
}

TEST_CASE(
    "link changes: a link along a wall is found even if its margin is never more than 1e-4 dB") {
    // Along a wall: the less slanted the ray the less wall it pays for; both ends move.
    constexpr double above = 1e-4;  // [dB] of the budget over the least loss
    const Scene scene = wall_with_gap(0, 0.5, {.per_metre = DbPerMeter{40}});
    test::Draw draw(9);
    for (int round = 0; round < 200; ++round) {
        CAPTURE(round);
        const Vec3 from{draw.uniform(-5, 0), draw.uniform(6, 12)};
        const Vec3 velocity{draw.uniform(0.5, 4), draw.uniform(-0.1, 1)};
        const Vec3 other_from{draw.uniform(10, 20), draw.uniform(-5, 3)};
        const Vec3 other_velocity{draw.uniform(-3, 0), draw.uniform(-1, 0.1)};
        const Leg legs[] = {moving(from, velocity, 10s), moving(other_from, other_velocity, 10s)};
        Db least{1e9};
        Time when{};
        MovingPair probe{&scene};
        for (const Leg& leg : legs) probe.add(Raytrace2007{}, leg);
        for (Time t = start_of_run; t <= start_of_run + 10s; t += 1ms)
            if (const Db loss = probe.medium.links().path_loss(a, b, t, probe.legs); loss < least)
                std::tie(least, when) = std::tuple(loss, t);
        if (when == start_of_run || when == start_of_run + 10s) continue;
        MovingPair pair{&scene};
        for (const Leg& leg : legs)
            pair.add(Raytrace2007{}, leg, {.power = {0}, .sensitivity = {-least.value - above}});
        const auto found = pair.changes(a, b, start_of_run, start_of_run + 10s);
        REQUIRE(found.size() == 2);
        CHECK(found[0] <= when + 1ms);
        CHECK(found[1] >= when);
    }
}

TEST_CASE(
    "link changes: behind a wall, a link that is up only near the closest approach is found") {
    // Down by 37 dB at the start and at half time, by 51 dB at the end; up within 2.94 m, where
    // 30 log10(200 / d) is the wall's 55 dB.
    const Scene scene(OccupancyGrid{.columns = 1,
                                    .rows = 1,
                                    .cell_width = 2000,
                                    .cell_height = 0.2,
                                    .origin = {-1000, 0.9, 0},
                                    .cells = {Cell::occupied}},
                      {{.per_crossing = 55_dB}});
    const Radio radio{.power = {0}, .sensitivity = {-itu_indoor_db(200, 2450_MHz, 30, 0)}};
    MovingPair pair{&scene};
    pair.add(Raytrace2007{}, resting({0, 1.3, 0}), radio);
    pair.add(Raytrace2007{}, moving({-50, 0, 0}, {10, 0, 0}, 20s), radio);
    const auto found = pair.changes(a, b, start_of_run, start_of_run + 20s);
    REQUIRE(found.size() == 2);
    const double half =
        std::sqrt(std::pow(200 * std::pow(10, -55.0 / 30), 2) - 1.3 * 1.3) / 10;  // [s]
    for (const double late : {seconds(found[0]) - (5 - half), seconds(found[1]) - (5 + half)}) {
        CHECK(late >= -1e-9);
        CHECK(late <= 1e-3 + 1e-9);  // the tolerance of the search
    }
}

namespace {

/// A change as dense sampling sees it: between two samples.
void check_against_sampling(const MovingPair& pair, NodeId from, NodeId to, Duration time,
                            const LinkSearch& search, int& seen) {
    constexpr Duration step = 1ms;
    const auto found = pair.changes(from, to, start_of_run, start_of_run + time, search);
    bool up = pair.up(from, to, start_of_run);
    for (const Time t : found) {  // each is one
        REQUIRE(pair.up(from, to, t) != up);
        up = !up;
    }
    REQUIRE(pair.up(from, to, start_of_run + time) == up);
    up = pair.up(from, to, start_of_run);
    for (Time t = start_of_run + step; t <= start_of_run + time; t += step) {
        const bool now = pair.up(from, to, t);
        if (now == up) continue;
        up = now;
        ++seen;
        const auto next = std::upper_bound(found.begin(), found.end(), t - step);
        CAPTURE(t.time_since_epoch().count());
        REQUIRE(next != found.end());
        CHECK(*next <= t + search.tolerance);
    }
}

/// Two maps that overlap, askew, of walls of several kinds; or one, plain.
Scene random_scene(test::Draw& draw, bool rich) {
    OccupancyGrid map = test::random_map(draw, 24, 24, 6);
    if (!rich) return Scene(map);
    for (std::size_t i = 0; i < map.cells.size(); ++i)
        map.cell_materials.push_back(static_cast<std::uint8_t>(draw.below(3)));
    OccupancyGrid askew = test::random_map(draw, 12, 12, 10);
    askew.origin = {4, 8, 0};
    askew.yaw = -0.6;
    return Scene({map, askew}, {{.per_crossing = 4_dB, .per_metre = DbPerMeter{3}},
                                {.per_crossing = 7_dB, .height = 2_m},
                                {.per_metre = DbPerMeter{11}, .height = 3_m}});
}

}  // namespace

TEST_CASE("link changes: for every model, the search finds all changes that dense sampling finds") {
    constexpr auto time = 4s;
    constexpr LinkSearch search{.tolerance = 1ms, .min_dwell = 1ms};
    const std::vector<Propagation> models{Friis{},
                                          LogDistance{},
                                          Raytrace2007{.wall_factor = 0.1},
                                          Raytrace2007{.coefficient = 22, .wall_factor = 0.02},
                                          Raytrace2007{.coefficient = 20},
                                          MultiWall{},
                                          ItuSiteGeneral{},
                                          TwoRay{.form = TwoRayForm::exact}};
    for (std::size_t m = 0; m < models.size(); ++m) {
        const bool rich = m == 4;
        test::Draw draw(static_cast<std::uint32_t>(100 + m));
        int seen = 0;
        for (int round = 0; round < 40; ++round) {
            CAPTURE(m);
            CAPTURE(round);
            const Scene scene = random_scene(draw, rich);
            MovingPair pair{&scene};
            for (int i = 0; i < 2; ++i) {
                Leg leg = random_leg(draw, 24, time);
                if (rich && leg.velocity != Vec3{}) {
                    leg.from.z = draw.uniform(0, 4);
                    leg.to.z = draw.below(2) ? leg.from.z : draw.uniform(0, 4);
                    leg.velocity.z = (leg.to.z - leg.from.z) / seconds(time);
                }
                pair.add(models[m], leg, {.power = {draw.uniform(-25, -15)}, .sensitivity = {-80}});
            }
            check_against_sampling(pair, a, b, time, search, seen);
            check_against_sampling(pair, b, a, time, search, seen);
        }
        MESSAGE(models[m].name() << ": " << seen << " changes");
        CHECK(seen > 20);
    }
}

TEST_CASE(
    "link changes: behind oblique walls the search finds all changes that dense sampling finds") {
    constexpr auto time = 4s;
    constexpr LinkSearch search{.tolerance = 1ms, .min_dwell = 1ms};
    constexpr double cell = 0.05, side = 6, angle = 0.35;
    OccupancyGrid map;  // walls of 15 cm, each 2 m long and 2 m from the next
    map.columns = map.rows = static_cast<int>(side / cell);
    map.cell_width = map.cell_height = cell;
    for (int i = 0; i < map.columns * map.rows; ++i) {
        const double x = (i % map.columns + 0.5) * cell, y = (i / map.columns + 0.5) * cell;
        const double along = std::cos(angle) * x + std::sin(angle) * y;
        const double across = std::cos(angle) * y - std::sin(angle) * x;
        const auto part = [](double v, double every) { return v - every * std::floor(v / every); };
        const bool wall = part(across, 2) < 0.15 && part(along, 3) < 2;
        map.cells.push_back(wall ? Cell::occupied : Cell::free);
    }
    const Scene scene(map);
    for (const Propagation& model : {Propagation(MultiWall{}), Propagation(ItuSiteGeneral{})}) {
        test::Draw draw(41);
        int seen = 0;
        for (int round = 0; round < 40; ++round) {
            CAPTURE(round);
            MovingPair pair{&scene};
            for (int i = 0; i < 2; ++i) {
                const Dbm power{draw.uniform(-25, -20)};
                pair.add(model, random_leg(draw, side, time),
                         {.power = power, .sensitivity = {-80}});
            }
            check_against_sampling(pair, a, b, time, search, seen);
        }
        CHECK(seen > 20);
    }
}

TEST_CASE("link changes: between storeys the search finds all changes that dense sampling finds") {
    constexpr auto time = 4s;
    constexpr LinkSearch search{.tolerance = 1ms, .min_dwell = 1ms};
    const std::vector<Propagation> models{MultiWall{.floor_loss = 6_dB},
                                          Raytrace2007{.wall_factor = 0.05},
                                          ItuIndoor{.environment = Environment::office}};
    for (std::size_t m = 0; m < models.size(); ++m) {
        test::Draw draw(static_cast<std::uint32_t>(200 + m));
        int seen = 0;
        for (int round = 0; round < 40; ++round) {
            CAPTURE(m);
            CAPTURE(round);
            OccupancyGrid upper = test::random_map(draw, 24, 24, 6);
            upper.origin.z = 2.5;
            const bool low = round % 2 == 0;
            const Scene scene({test::random_map(draw, 24, 24, 6), upper},
                              {low ? Material{.height = 1.5_m} : Material{}},
                              {round % 3 == 0 ? Material{} : Material{.per_crossing = 9_dB}});
            MovingPair pair{&scene};
            for (int i = 0; i < 2; ++i) {
                Leg leg = random_leg(draw, 24, time);
                leg.from.z = leg.to.z = draw.uniform(0, 5);
                if (leg.velocity != Vec3{} && draw.below(2)) leg.to.z = draw.uniform(0, 5);
                leg.velocity.z = (leg.to.z - leg.from.z) / seconds(time);
                pair.add(models[m], leg, {.power = {draw.uniform(-22, -8)}, .sensitivity = {-80}});
            }
            check_against_sampling(pair, a, b, time, search, seen);
            check_against_sampling(pair, b, a, time, search, seen);
        }
        MESSAGE(models[m].name() << ": " << seen << " changes");
        CHECK(seen > 20);
    }
}

TEST_CASE("link changes: between equal radios, both directions of a link change at the same time") {
    // So slow that rounding moves the times of passages by many nanoseconds.
    constexpr Duration time = 5'000'000'000s;
    test::Draw draw(10);
    std::size_t seen = 0;
    for (int round = 0; round < 80; ++round) {
        const Scene scene = random_scene(draw, true);
        MovingPair pair{&scene};
        for (int i = 0; i < 2; ++i)
            pair.add(Raytrace2007{}, random_leg(draw, 24, time),
                     {.power = {-20}, .sensitivity = {-80}});
        const auto found = pair.changes(a, b, start_of_run, start_of_run + time);
        CHECK(pair.changes(b, a, start_of_run, start_of_run + time) == found);
        seen += found.size();
    }
    CHECK(seen > 20);
}

}  // namespace link_changes_walls_test
