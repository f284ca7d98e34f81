// SPDX-License-Identifier: MIT
#include "network/link_watch.hpp"

#include "models/medium/medium.hpp"
#include "models/propagation/list.hpp"
#include "network/network.hpp"
#include "sim/error.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace link_watch_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

/// Up where the whole metres are even; counts how often it is asked.
struct CountedRings {
    static constexpr std::string_view name = "counted_rings";
    int* looks;
    void loss(const LinkBatch& links, Db, std::span<double> out_db) const {
        ++*looks;
        for (std::size_t i = 0; i < out_db.size(); ++i)
            out_db[i] = static_cast<int>(links.distance(i)) % 2 ? 1000 : 0;
    }
};

/// Robots, the air between them, and the watch.
struct Harness {
    const Scene* scene;
    LinkSearch search = {};
    Legs legs{};
    Medium medium{{.scene = scene}};
    LinkWatch watch{{.medium = &medium, .legs = &legs, .scene = scene, .search = search}};
    std::vector<LinkChange> told{};

    NodeId add(const Propagation& model, const Leg& leg, const Radio& radio = {}) {
        medium.add(radio, legs.size() + 1, model);
        return legs.add(leg);
    }
    /// Serves everything due up to `t`, each at its own time.
    void run_until(Time t) {
        while (watch.next() && *watch.next() <= t) serve(*watch.next());
        serve(t);
    }
    void serve(Time t) {
        watch.advance(t, [&](const LinkChange& change) { told.push_back(change); });
    }
    std::vector<LinkChange> take() { return std::exchange(told, {}); }
    void replace(NodeId node, const Leg& leg) {
        legs.replace(node, leg);
        watch.changed(node, leg.start);
    }
    /// Every pair is told as it is at `t`.
    void check(Time t) const {
        for (std::uint32_t i = 0; i < legs.size(); ++i)
            for (std::uint32_t j = 0; j < legs.size(); ++j)
                CHECK(watch.is_up({i}, {j}) == medium.links().is_up({i}, {j}, t, legs));
    }
};

Leg resting(Vec3 at, Time start = start_of_run) { return {.start = start, .from = at, .to = at}; }

Leg moving(Time start, Vec3 from, Vec3 to, Duration time) {
    return {.start = start,
            .end = start + time,
            .from = from,
            .velocity = (1 / seconds(time)) * (to - from),
            .to = to};
}

constexpr NodeId a{0}, b{1}, c{2};
constexpr Time begin = start_of_run;

}  // namespace

TEST_CASE(
    "link watch: links that are up at the start are reported at once, in the order of robots") {
    const Scene field;
    Harness network{&field};
    for (const double x : {0.0, 8.0, 16.0}) network.add(Disc{.range = 10_m}, resting({x, 0, 0}));
    network.watch.start(begin + 1s);
    CHECK(network.watch.next() == begin + 1s);
    network.run_until(begin + 1s);
    CHECK(network.take() == std::vector<LinkChange>{{begin + 1s, a, b, true},
                                                    {begin + 1s, b, a, true},
                                                    {begin + 1s, b, c, true},
                                                    {begin + 1s, c, b, true}});
    CHECK_FALSE(network.watch.next());  // nobody moves
}

TEST_CASE(
    "link watch: if two robots with different ranges pass each other, each is heard within its own "
    "range") {
    const Scene field;
    Harness network{&field};
    network.add(Disc{.range = 10_m}, resting({}));
    network.add(Disc{.range = 5_m}, moving(begin, {-20, 0, 0}, {20, 0, 0}, 40s));
    network.watch.start(begin);
    network.run_until(begin + 40s);
    CHECK(network.take() == std::vector<LinkChange>{{begin + 10s, a, b, true},
                                                    {begin + 15s, b, a, true},
                                                    {begin + 25s + 1ns, b, a, false},
                                                    {begin + 30s + 1ns, a, b, false}});
    CHECK_FALSE(network.watch.next());
}

TEST_CASE(
    "link watch: a new movement of a node cancels the changes predicted for its old movement") {
    const Scene field;
    Harness network{&field};
    network.add(Disc{.range = 10_m}, resting({}));
    network.add(Disc{.range = 10_m}, moving(begin, {-20, 0, 0}, {20, 0, 0}, 40s));
    network.watch.start(begin);
    network.run_until(begin + 9s);
    network.replace(b, moving(begin + 9s, {-11, 0, 0}, {-20, 0, 0}, 9s));
    CHECK_FALSE(network.watch.next());
    network.run_until(begin + 18s);
    CHECK(network.take().empty());
    // A leap changes the links at once.
    network.replace(b, resting({0, 1, 0}, begin + 18s));
    CHECK(network.watch.next() == begin + 18s);
    network.run_until(begin + 18s);
    CHECK(network.take() ==
          std::vector<LinkChange>{{begin + 18s, a, b, true}, {begin + 18s, b, a, true}});
    // There and back before anything was told is no change.
    network.replace(b, resting({99, 0, 0}, begin + 20s));
    network.replace(b, resting({0, 2, 0}, begin + 20s));
    network.run_until(begin + 20s);
    CHECK(network.take().empty());
}

TEST_CASE("link watch: one call reports all changes that are due, and none that were cancelled") {
    const Scene field;
    Harness network{&field};
    network.add(Disc{.range = 10_m}, resting({}));
    network.add(Disc{.range = 0_m}, moving(begin, {-20, 0, 0}, {20, 0, 0}, 40s));
    network.add(Disc{.range = 0_m}, moving(begin, {-15, 0, 0}, {25, 0, 0}, 40s));
    network.watch.start(begin);
    network.replace(b, moving(begin, {-20, 0, 0}, {20, 0, 0}, 120s));  // would have come at 10 s
    network.serve(begin + 40s);
    CHECK(network.take() == std::vector<LinkChange>{{begin + 5s, a, c, true},
                                                    {begin + 25s + 1ns, a, c, false},
                                                    {begin + 30s, a, b, true}});
}

TEST_CASE(
    "link watch: a change at the end of a movement is reported once, even if a new movement "
    "follows") {
    const Scene field;
    for (const bool served_first : {false, true}) {
        Harness network{&field};
        network.add(Disc{.range = 10_m}, resting({}));
        network.add(Disc{.range = 10_m}, moving(begin, {-20, 0, 0}, {-10, 0, 0}, 10s));
        network.watch.start(begin);
        network.run_until(begin + 10s - 1ns);
        if (served_first) network.run_until(begin + 10s);
        network.replace(b, resting({-10, 0, 0}, begin + 10s));
        network.run_until(begin + 10s);
        CHECK(network.take() ==
              std::vector<LinkChange>{{begin + 10s, a, b, true}, {begin + 10s, b, a, true}});
    }
}

TEST_CASE(
    "link watch: switching a radio off takes its links down, and switching it on brings them up") {
    const Scene field;
    Harness network{&field};
    network.add(Disc{.range = 10_m}, resting({}));
    network.add(Disc{.range = 10_m}, moving(begin, {-20, 0, 0}, {20, 0, 0}, 40s));
    network.watch.start(begin);
    const auto turn = [&](bool on, Time t) {
        network.run_until(t);
        network.medium.switch_radio(a, on);
        network.watch.changed(a, t);
        network.run_until(t);
        network.check(t);
    };
    turn(false, begin + 12s);
    turn(true, begin + 20s);
    CHECK(network.take() == std::vector<LinkChange>{{begin + 10s, a, b, true},
                                                    {begin + 10s, b, a, true},
                                                    {begin + 12s, a, b, false},
                                                    {begin + 12s, b, a, false},
                                                    {begin + 20s, a, b, true},
                                                    {begin + 20s, b, a, true}});
    CHECK(network.watch.next() == begin + 30s + 1ns);
}

TEST_CASE("link watch: a robot that joins later has links from then on") {
    const Scene field;
    Harness network{&field};
    network.watch.start(begin);
    for (const double x : {0.0, 4.0, 30.0}) {
        const Time now = begin + from_seconds(x);
        const NodeId node = network.add(Disc{.range = 10_m}, resting({x, 0, 0}, now));
        network.watch.added(node, now);
        network.run_until(now);
    }
    CHECK(network.take() ==
          std::vector<LinkChange>{{begin + 4s, a, b, true}, {begin + 4s, b, a, true}});
}

namespace {

/// Up where the whole metres are even.
struct Rings {
    static constexpr std::string_view name = "rings";
    void loss(const LinkBatch& links, Db, std::span<double> out_db) const {
        for (std::size_t i = 0; i < out_db.size(); ++i)
            out_db[i] = static_cast<int>(links.distance(i)) % 2 ? 1000 : 0;
    }
};

/// Ten robots with legs of a second each; what is told until `end`, by their places in `order`.
std::vector<LinkChange> wander(const Scene& scene, const std::vector<std::uint32_t>& order,
                               Time end) {
    Harness network{&scene};
    const Propagation models[] = {Friis{}, Raytrace2007{.coefficient = 24, .wall_factor = 0.05}};
    const auto place = [](std::uint32_t robot, Time t) {
        test::Draw draw(robot * 1000 + static_cast<std::uint32_t>(seconds(t)));
        return Vec3{draw.uniform(0, 24), draw.uniform(0, 24), 0};
    };
    const auto leg = [&](std::uint32_t robot, Time t) {
        return moving(t, place(robot, t), place(robot, t + 1s), 1s);
    };
    for (const std::uint32_t robot : order)
        network.add(models[robot % 2], leg(robot, begin),
                    {.power = {-22.0 + robot % 3}, .sensitivity = {-80}});
    network.watch.start(begin);
    for (Time t = begin + 1s; t <= end; t += 1s) {
        network.run_until(t - 1ns);
        for (std::uint32_t i = 0; i < order.size(); ++i) network.replace({i}, leg(order[i], t));
        network.run_until(t);
        network.check(t);
    }
    for (LinkChange& change : network.told) {
        change.from = {order[change.from.index()]};
        change.to = {order[change.to.index()]};
    }
    return network.take();
}

auto key(const LinkChange& change) { return std::tie(change.time, change.from, change.to); }

}  // namespace

TEST_CASE("link watch: changes do not depend on the order in which robots are added") {
    test::Draw draw(3);
    const Scene scene(test::random_map(draw, 24, 24, 6));
    std::vector<std::uint32_t> order{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const auto expected = wander(scene, order, begin + 20s);
    CHECK(expected.size() > 100);
    CHECK(std::is_sorted(expected.begin(), expected.end(),
                         [](const auto& p, const auto& q) { return key(p) < key(q); }));
    std::reverse(order.begin() + 2, order.end());
    auto found = wander(scene, order, begin + 20s);
    std::sort(found.begin(), found.end(),
              [](const auto& p, const auto& q) { return key(p) < key(q); });
    CHECK(found == expected);
}

TEST_CASE(
    "link watch: if the loss is an arbitrary function, it is sampled as long as robots move") {
    const Scene field;
    Harness network{&field, {.tolerance = 1ns, .min_dwell = 10us}};
    network.add(Rings{}, resting({}));
    network.add(Rings{}, {.velocity = {0.1, 0, 0}});
    network.watch.start(begin);
    // A look each 10 us is 65536 looks in 0.66 s; then it must look again.
    network.run_until(begin + 25s);
    CHECK(network.take() == std::vector<LinkChange>{{begin, a, b, true},
                                                    {begin, b, a, true},
                                                    {begin + 10s, a, b, false},
                                                    {begin + 10s, b, a, false},
                                                    {begin + 20s, a, b, true},
                                                    {begin + 20s, b, a, true}});
}

TEST_CASE(
    "link watch: if the loss is an arbitrary function, it is not sampled far beyond the current "
    "time") {
    const Scene field;
    Harness network{&field, {.tolerance = 1ms, .min_dwell = 100ms}};
    int looks = 0;
    network.add(CountedRings{&looks}, resting({}));
    network.add(CountedRings{&looks},
                moving(begin, {}, {1000, 0, 0}, 1'000'000s));  // 1 mm/s: a change in 1000 s
    network.watch.start(begin);
    // Two links, each with ten looks a second, and at most as many ahead.
    network.run_until(begin + 20s);
    CHECK(looks >= 2 * 10 * 20);
    CHECK(looks <= 2 * (2 * 10 * 20 + 20));
    constexpr int run = 10'000, changes = run / 1000, of_a_change = 20;  // [s], -, looks
    network.run_until(begin + run * 1s);
    CHECK(looks >= 2 * 10 * run);
    CHECK(looks <= 2 * (2 * 10 * run + changes * of_a_change));
    network.check(begin + run * 1s);
    CHECK(network.take().size() == 2 * (1 + changes));
}

TEST_CASE("link watch: a network with too many robots is refused") {
    const Scene field;
    Harness network{&field};
    const Propagation disc = Disc{.range = 10_m};
    for (std::size_t i = 0; i <= LinkWatch::most_robots; ++i) network.add(disc, resting({}));
    CHECK_THROWS_AS(network.watch.start(begin), RunError);
}

TEST_CASE("link watch: if a directional antenna turns in place, its links change during the turn") {
    const Scene field;
    Harness network{&field, {.tolerance = 1us, .min_dwell = 10ms}};
    const Radio sector{.antenna = AntennaShape::cosine, .antenna_beamwidth = Radians{1}};
    Leg turning = resting({});
    turning.end = begin + 1000s;  // longer than one search looks ahead
    turning.heading = -3;
    turning.turning = 0.006;
    network.add(Friis{}, turning, sector);
    network.add(Friis{}, resting({200, 0, 0}));
    network.watch.start(begin);
    for (int s = 0; s <= 1000; s += 50) {
        network.run_until(begin + s * 1s);
        network.check(begin + s * 1s);
    }
    const auto told = network.take();
    REQUIRE(told.size() == 4);  // both ways, in and out
    for (const LinkChange& change : told) {
        CHECK(network.medium.links().is_up(change.from, change.to, change.time, network.legs) ==
              change.up);
        CHECK(network.medium.links().is_up(change.from, change.to, change.time - 1us,
                                           network.legs) != change.up);
    }
    // Another heading at rest is a change at once.
    Leg ahead = resting({}, begin + 1001s);
    network.replace(a, ahead);
    network.run_until(begin + 1001s);
    CHECK(network.take().size() == 2);
}

}  // namespace link_watch_test
