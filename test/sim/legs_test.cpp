// SPDX-License-Identifier: MIT
#include "sim/legs.hpp"

#include "sim/random.hpp"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <malloc.h>
#include <vector>

namespace legs_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }
bool same(Vec3 a, Vec3 b) {
    return bits_of(a.x) == bits_of(b.x) && bits_of(a.y) == bits_of(b.y) &&
           bits_of(a.z) == bits_of(b.z);
}
bool same(const Leg& a, const Leg& b) {
    return a.start == b.start && a.end == b.end && same(a.from, b.from) &&
           same(a.velocity, b.velocity) && same(a.to, b.to) &&
           bits_of(a.heading) == bits_of(b.heading) && bits_of(a.turning) == bits_of(b.turning);
}

constexpr Time begin = start_of_run + 5s;
constexpr Vec3 here{1, -2, 3};
constexpr Leg standing{.start = begin, .from = here, .to = here, .heading = 2};

/// Legs that differ from a standing one in one thing each, and ordinary ones.
std::vector<Leg> kinds_of_legs() {
    std::vector<Leg> all(15, standing);
    all[1].end = begin + 3s;
    all[2].velocity = {0, 0, 0.5};
    all[3].velocity = {0, -0.0, 0};
    all[4].to = {1, -2, 4};
    all[5].from = all[5].to = {0, 0, 0};
    all[6].from = all[6].to = {-0.0, 0, -0.0};
    all[7].from = {0, 0, 0};
    all[7].to = {0, -0.0, 0};
    all[8].turning = 0.1;
    all[9].turning = -0.0;
    all[10] = {.start = begin,
               .end = begin + 2s,
               .from = here,
               .velocity = {1, 1, 0},
               .to = {3.5, 0, 3},
               .heading = 0.75};
    all[11] = {};
    // That one again, but not quite at one height, or turning.
    all[12] = all[13] = all[14] = all[10];
    all[12].velocity.z = -0.0;
    all[13].to.z = 3.0000000000000004;
    all[14].turning = -0.0;
    return all;
}

}  // namespace

TEST_CASE("legs: each stored leg (piece of movement) of a node is read back bit for bit") {
    const auto kinds = kinds_of_legs();
    for (const Leg& first : kinds) {
        for (const Leg& second : kinds) {
            Legs legs;
            const NodeId node = legs.add(first);
            CHECK(same(legs.leg(node), first));
            legs.replace(node, second);
            CHECK(same(legs.leg(node), second));
        }
    }
}

TEST_CASE(
    "legs: a node is exactly where its leg (piece of movement) leads, also after the leg's end") {
    Legs legs;
    for (const Leg& leg : kinds_of_legs()) {
        const NodeId node = legs.add(leg);
        for (const Duration d : std::array<Duration, 4>{0ns, 1ns, 2500ms, 1h}) {
            CHECK(same(legs.position(node, begin + d), leg.position(begin + d)));
        }
    }
}

TEST_CASE("legs: after many changes every node has the leg (piece of movement) that was set last") {
    constexpr std::uint32_t nodes = 50;
    const auto kinds = kinds_of_legs();
    Legs legs;
    legs.reserve(nodes / 2);
    std::vector<Leg> given;
    std::vector<std::uint32_t> versions(nodes);
    for (std::uint32_t i = 0; i < nodes; ++i) {
        given.push_back(kinds[i % kinds.size()]);
        CHECK(legs.add(given.back()) == NodeId{i});
    }
    for (std::uint64_t change = 0; change < 5000; ++change) {
        const auto node = static_cast<std::uint32_t>(below({.seed = 1, .index = change}, nodes));
        given[node] = kinds[below({.seed = 2, .index = change}, kinds.size())];
        given[node].heading = static_cast<double>(change);
        legs.replace(NodeId{node}, given[node]);
        ++versions[node];
    }
    for (std::uint32_t i = 0; i < nodes; ++i) {
        CHECK(same(legs.leg(NodeId{i}), given[i]));
        CHECK(legs.version(NodeId{i}) == versions[i]);
    }
    CHECK(legs.size() == nodes);
}

TEST_CASE("legs: a node that starts and stops again and again does not take more and more memory") {
    const Leg moving{.start = begin, .end = begin + 1s, .velocity = {1, 0, 0}, .to = {1, 0, 0}};
    Legs legs;
    const NodeId node = legs.add(standing);
    const auto walk = [&] {
        for (int i = 0; i < 1000; ++i) {
            legs.replace(node, moving);
            legs.replace(node, moving);
            legs.replace(node, standing);
        }
    };
    walk();
    const auto before = mallinfo2().uordblks;
    walk();
    CHECK(mallinfo2().uordblks == before);
}

TEST_CASE(
    "legs: after a million computed positions, a robot's position has no rounding error (S30)") {
    Legs legs;
    legs.add({.start = start_of_run,
              .end = start_of_run + 200'000s,
              .velocity = {1, 0},
              .to = {2e5, 0}});
    const NodeId robot{0};
    Vec3 last;
    for (int i = 1; i <= 1'000'000; ++i) last = legs.position(robot, start_of_run + i * 100ms);
    CHECK(last.x == 100'000);  // 0.1 m added a million times is 1.3 micrometres off
}

}  // namespace legs_test
