// SPDX-License-Identifier: MIT
#include "models/medium/neighbour_index.hpp"

#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace neighbour_index_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

/// Nodes on legs of their own and an index over them.
struct Swarm {
    test::Draw draw;
    Legs legs{};
    NeighbourIndex index{};
    Time now = start_of_run;

    explicit Swarm(std::uint32_t seed) : draw(seed) {}

    Leg leg(Vec3 from, double top_speed) {
        const double speed = draw.uniform(0, top_speed), angle = draw.uniform(0, 6.3);
        const Vec3 velocity{speed * std::cos(angle), speed * std::sin(angle), draw.uniform(-1, 1)};
        const Duration lasts{static_cast<std::int64_t>(draw.uniform(1e6, 3e10))};
        return {.start = now,
                .end = now + lasts,
                .from = from,
                .velocity = velocity,
                .to = from + seconds(lasts) * velocity};
    }
    void add(Vec3 at, double top_speed) {
        index.add(static_cast<std::uint32_t>(legs.size()) % 7);
        legs.add(leg(at, top_speed));
    }
    void replace(NodeId node, const Leg& leg) {
        legs.replace(node, leg);
        index.moved(node, legs);
    }
    /// Where everybody is, also between an add() and the next refresh().
    void check_positions() {
        for (std::uint32_t i = 0; i < legs.size(); ++i) {
            CHECK(index.position_of(NodeId{i}, now, legs) == legs.position(NodeId{i}, now));
        }
    }
    /// Those within `radius` of `centre`, each once, as the index and as a look at everybody has
    /// it.
    void check_query(Vec3 centre, double radius) {
        index.refresh(now, legs);
        std::vector<int> seen(legs.size());
        index.visit(centre, radius, now, legs, [&](const NeighbourIndex::Entry& e, Vec3 p) {
            ++seen[e.node.index()];
            CHECK(p == legs.position(e.node, now));
            CHECK(e.label == e.node.value % 7);
        });
        for (std::uint32_t i = 0; i < legs.size(); ++i) {
            const bool within = distance(centre, legs.position(NodeId{i}, now)) <= radius;
            REQUIRE(seen[i] <= 1);
            if (within) REQUIRE(seen[i] == 1);
        }
        check_first_look(centre, radius, seen);
    }
    /// The same with a first look: it is told no more than the squared distance, and of whom it
    /// does not let pass nothing is heard again.
    void check_first_look(Vec3 centre, double radius, const std::vector<int>& seen) {
        std::vector<int> visited(legs.size()), stopped(legs.size());
        const auto passes = [&](std::uint32_t place, double at_least) {
            const NodeId node = index.entries()[place].node;
            const Vec3 p = legs.position(node, now);
            const double dx = p.x - centre.x, dy = p.y - centre.y;
            REQUIRE(at_least >= 0);
            REQUIRE(at_least <= dx * dx + dy * dy);
            stopped[node.index()] += node.value % 3 == 0;
            return node.value % 3 != 0;
        };
        index.visit_if(centre, radius, now, legs, passes,
                       [&](const NeighbourIndex::Entry& e, Vec3 p, std::uint32_t place) {
                           ++visited[e.node.index()];
                           CHECK(p == legs.position(e.node, now));
                           const bool binned = place != NeighbourIndex::nowhere;
                           if (binned) CHECK(&index.entries()[place] == &e);
                       });
        for (std::size_t i = 0; i < seen.size(); ++i) REQUIRE(visited[i] + stopped[i] == seen[i]);
    }
};

}  // namespace

TEST_CASE(
    "neighbour index: all nodes found by a full search are found, while nodes move and turn") {
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        Swarm swarm(seed);
        const double size = std::pow(10, swarm.draw.uniform(0, 5));
        const double top_speed = std::pow(10, swarm.draw.uniform(-2, 3));
        const auto place = [&] {
            return Vec3{swarm.draw.uniform(-size, size), swarm.draw.uniform(-size, size),
                        swarm.draw.uniform(0, 3)};
        };
        const int nodes = static_cast<int>(swarm.draw.uniform(1, 200));
        for (int i = 0; i < nodes; ++i)
            swarm.add(place(), i % 50 == 0 ? 30 * top_speed : top_speed);
        swarm.index.set_cell_size(size * std::pow(10, swarm.draw.uniform(-3, 1)));
        for (int step = 0; step < 60; ++step) {
            swarm.now += Duration{static_cast<std::int64_t>(swarm.draw.uniform(0, 1e9))};
            for (std::uint32_t i = 0; i < swarm.legs.size(); ++i) {
                const NodeId node{i};
                const bool over = swarm.now >= swarm.legs.leg(node).end;
                if (!over && swarm.draw.uniform(0, 1) > 0.05) continue;
                const bool jumps = swarm.draw.uniform(0, 1) < 0.02;
                const Vec3 at = jumps ? place() : swarm.legs.position(node, swarm.now);
                swarm.replace(node, swarm.leg(at, top_speed));
            }
            if (step == 30) swarm.add(place(), top_speed);
            swarm.check_positions();
            swarm.check_query(place(), size * swarm.draw.uniform(0, 1));
        }
    }
}

TEST_CASE("neighbour index: for a node at rest, the lower bound is close to its true distance") {
    Swarm swarm(7);
    const auto place = [&] {
        return Vec3{swarm.draw.uniform(0, 1e4), swarm.draw.uniform(0, 1e4), 0};
    };
    for (int i = 0; i < 500; ++i) swarm.add(place(), 0);
    swarm.index.set_cell_size(500);
    swarm.index.refresh(swarm.now, swarm.legs);
    int looked_at = 0;
    for (int query = 0; query < 100; ++query) {
        const Vec3 centre = place();
        const auto passes = [&](std::uint32_t i, double at_least) {
            const Vec3 p = swarm.index.entries()[i].from;
            const double dx = p.x - centre.x, dy = p.y - centre.y, d2 = dx * dx + dy * dy;
            CHECK(d2 - at_least < 100 + 1e-3 * d2);
            ++looked_at;
            return false;
        };
        swarm.index.visit_if(
            centre, 500, swarm.now, swarm.legs, passes,
            [](const NeighbourIndex::Entry&, Vec3, std::uint32_t) { FAIL("passed"); });
    }
    CHECK(looked_at > 300);
}

TEST_CASE("neighbour index: a node whose movement has no end is found") {
    Swarm swarm(4);
    for (int i = 0; i < 20; ++i) {
        swarm.index.add(static_cast<std::uint32_t>(i) % 7);
        const Vec3 from{10.0 * i, 0, 0};
        swarm.legs.add({.from = from, .velocity = {0, 1.0 * i, 0}, .to = from});
    }
    swarm.index.set_cell_size(20);
    for (int step = 0; step < 30; ++step, swarm.now += 1s) {
        swarm.check_query({100, 10.0 * step, 0}, 50);
    }
}

TEST_CASE(
    "neighbour index: nodes at 1e9 m, in one place or on a line are found, also with a search "
    "radius of 0") {
    Swarm swarm(3);
    for (int i = 0; i < 300; ++i) swarm.add({5, 5, 0}, 0);
    for (int i = 0; i < 300; ++i) swarm.add({10.0 * i, -70, 0}, 1);
    swarm.add({1e9, 1e9, 0}, 2);
    swarm.add({-1e300, 3, 0}, 0);
    for (const double cell : {1e-9, 1.0, 100.0, 1e12}) {
        swarm.index.set_cell_size(cell);
        for (const double radius : {0.0, 1.0, 75.0, 2e9, std::numeric_limits<double>::infinity()}) {
            swarm.now += 20ms;
            swarm.check_query({5, 5, 0}, radius);
            swarm.check_query({1e9, 1e9, 0}, radius);
        }
    }
}

}  // namespace neighbour_index_test
