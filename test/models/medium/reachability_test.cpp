// SPDX-License-Identifier: MIT
#include "models/medium/reachability.hpp"

#include "models/medium/medium.hpp"
#include "models/propagation/disc.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "models/propagation/two_ray.hpp"
#include "scene/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace reachability_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Rooms of 5 m in a building of 20 m x 20 m, each with a door.
Scene office() {
    OccupancyGrid grid;
    grid.columns = grid.rows = 200;
    grid.cell_width = grid.cell_height = 0.1;
    grid.cells.assign(200 * 200, Cell::free);
    for (int row = 0; row < 200; ++row) {
        for (int column = 0; column < 200; ++column) {
            const bool wall = row % 50 == 0 || column % 50 == 0;
            const bool door = row % 50 == 25 || column % 50 == 25;
            if (wall && !door)
                grid.cells[static_cast<std::size_t>(200 * row + column)] = Cell::occupied;
        }
    }
    return Scene(grid);
}

/// How a random world is.
struct World {
    std::string name;
    Propagation model;
    bool walls = false;
    bool moving = true;
    int kinds = 1;     ///< of radios
    double side = 20;  ///< [m]
    Dbm sensitivity{-90};
};

/// Robots in a random world, asked in random steps of time; some are switched, added, turned.
class RandomWorld {
  public:
    RandomWorld(const World& world, unsigned seed)
        : world_(world),
          scene_(world.walls ? office() : Scene{}),
          medium_({.scene = &scene_, .seed = seed}),
          draw_(seed) {
        for (int i = 0; i < 40; ++i) add();
    }

    /// Every robot's number is that of a search of its own, now and after each change.
    void check() {
        for (int step = 0; step < 60; ++step) {
            now_ += Duration{below(world_.moving ? 400'000'000 : 1000)};
            change();
            const int asked = below(4);
            for (int i = 0; i <= asked; ++i)
                check_one(NodeId{static_cast<std::uint32_t>(below(size()))});
        }
    }

  private:
    int below(int n) { return static_cast<int>(draw_() % static_cast<unsigned>(n)); }
    int size() const { return static_cast<int>(legs_.size()); }
    double coordinate() { return world_.side * below(100'000) / 1e5; }
    Leg leg(Vec3 from) {
        Leg leg{.start = now_, .from = from, .to = from};
        if (!world_.moving || below(8) == 0) return leg;
        leg.to = {coordinate(), coordinate(), 0};
        const double seconds_under_way = 1 + below(10);
        leg.end = now_ + from_seconds(seconds_under_way);
        leg.velocity = (1 / seconds_under_way) * (leg.to - from);
        return leg;
    }
    void add() {
        Radio radio{.sensitivity = world_.sensitivity};
        radio.power = Dbm{5.0 * below(world_.kinds)};
        legs_.add(leg({coordinate(), coordinate(), 0}));
        medium_.add(radio, draw_(), world_.model);
    }
    void change() {
        for (std::uint32_t n = 0; n < legs_.size(); ++n) {
            if (legs_.leg(NodeId{n}).end > now_) continue;
            legs_.replace(NodeId{n}, leg(legs_.position(NodeId{n}, now_)));
            medium_.moved(NodeId{n}, legs_);
        }
        const NodeId one{static_cast<std::uint32_t>(below(size()))};
        if (below(3) == 0) medium_.switch_radio(one, !medium_.stations().is_on(one));
        if (below(20) == 0) add();
        if (below(10) == 0) {  // put somewhere else
            const Vec3 there{coordinate(), coordinate(), 0};
            legs_.replace(one, {.start = now_, .from = there, .to = there});
            medium_.moved(one, legs_);
        }
    }
    void check_one(NodeId from) {
        CHECK(reachability_.count(medium_, from, now_, legs_) ==
              Reachability::count_anew(medium_, from, now_, legs_));
        const NodeId to{static_cast<std::uint32_t>(below(size()))};
        if (to == from) return;
        const bool reached = reachability_.reaches(medium_, from, to, now_, legs_);
        const bool was_on = medium_.stations().is_on(to);
        const auto all = Reachability::count_anew(medium_, from, now_, legs_);
        if (!was_on) {
            CHECK_FALSE(reached);
            return;
        }
        // It is reached if and only if fewer are without it, unless others are reached by it only.
        if (!reached) {
            medium_.switch_radio(to, false);
            CHECK(Reachability::count_anew(medium_, from, now_, legs_) == all);
            medium_.switch_radio(to, true);
        }
    }

    const World& world_;
    Scene scene_;
    Medium medium_;
    Legs legs_;
    Reachability reachability_;
    std::mt19937 draw_;
    Time now_ = start_of_run;
};

}  // namespace

TEST_CASE(
    "reachability: numbers of reachable robots equal those of a search without cache, in ten "
    "kinds of random scenes") {
    const World worlds[] = {
        {.name = "a sparse disc", .model = Disc{.range = {3}}},
        {.name = "a dense disc", .model = Disc{.range = {6}}},
        {.name = "discs at rest", .model = Disc{.range = {3.5}}, .moving = false},
        {.name = "friis, three radios", .model = Friis{}, .kinds = 3, .side = 3000},
        {.name = "three radios at rest",
         .model = Friis{},
         .moving = false,
         .kinds = 3,
         .side = 3000},
        {.name = "shadowing", .model = LogDistance{.exponent = 3, .sigma = Db{6}}, .side = 400},
        {.name = "two rays", .model = TwoRay{}, .side = 900},
        {.name = "walls", .model = Raytrace2007{}, .walls = true, .sensitivity = {-62}},
        {.name = "walls, two radios",
         .model = Raytrace2007{},
         .walls = true,
         .kinds = 2,
         .sensitivity = {-60}},
        {.name = "walls at rest",
         .model = Raytrace2007{},
         .walls = true,
         .moving = false,
         .sensitivity = {-62}},
    };
    for (const World& world : worlds) {
        CAPTURE(world.name);
        for (unsigned seed = 1; seed <= 8; ++seed) RandomWorld(world, seed).check();
    }
}

}  // namespace reachability_test
