// SPDX-License-Identifier: MIT
// Receptions come in order of time, then of node, in whatever portions they are served.
#include "mobility/random_waypoint.hpp"
#include "models/propagation/list.hpp"
#include "network/network.hpp"
#include "routing/flood_router.hpp"
#include "test/network/reception_log.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace order_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

using namespace std::chrono_literals;

/// A flood that looks at the order of its receptions, and at the clock: it shows when the last of
/// those that are served together came.
struct WatchedFlood {
    FloodRouter flood{Flood{.jitter = 100us}};
    std::shared_ptr<bool> always_in_order;
    Hops initial_ttl() const { return flood.initial_ttl(); }
    void send(LinkLayer& link, NodeId node, MessageId m) { flood.send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        REQUIRE(!receptions.empty());
        REQUIRE(link.now() == receptions.back().time);
        *always_in_order = *always_in_order && in_order(receptions);
        flood.on_receive(link, frame, receptions);
    }
    void forget(MessageId message) { flood.forget(message); }
};

constexpr int robots = 60;

/// Robots that run about; some start in a grid, at many equal distances.
struct Playground {
    Network net;

    Playground(const Setting& setting, std::uint32_t seed)
        : net({.seed = seed,
               .propagation = setting.propagation,
               .reception = setting.reception,
               .access = setting.access,
               .reference = setting.reference,
               .metrics = false}) {
        test::Draw draw(seed);
        for (int i = 0; i < robots; ++i) {
            Vec3 at{draw.uniform(0, 500), draw.uniform(0, 500), 0};
            const int place = i / 2 * 7 % 30;  // so that their ids are not in order of place
            if (i % 2 == 0) at = {60.0 * (place % 6), 60.0 * (place / 6), 0};
            Movement move = Fixed{};
            if (i % 3 == 1) {
                move = RandomWaypoint{
                    .area = {{0, 0, 0}, {500, 500, 0}}, .min_speed = {1}, .max_speed = {300}};
            }
            net.add({.name = {}, .at = at, .radio = setting.radio, .move = move});
        }
    }
    /// Floods from robots of the grid that stand still. Some begin together, so that frames come in
    /// between the receptions of others.
    std::shared_ptr<ReceptionLog> run(Router router, Duration step = 1s) {
        auto log = std::make_shared<ReceptionLog>();
        net.add_sink(Sink{log});
        net.route(std::move(router));
        for (std::uint32_t i = 0; i < robots; i += 6) {
            const auto begin = (i < robots / 2 ? i / 12 : i / 6) * 10ms;
            net.at(start_of_run + begin, [this, i] { net.send({i}, everyone, "hello"); });
        }
        while (net.now() < start_of_run + 1s) {
            log->end_of_run = net.now() + step;
            net.run_for(step);
        }
        return log;
    }
};

std::shared_ptr<ReceptionLog> run(const Setting& setting, std::uint32_t seed) {
    return Playground(setting, seed).run(setting.flood);
}

}  // namespace

TEST_CASE(
    "order: one event for several receptions gives the same records as one event for each "
    "reception") {
    for (Setting setting : settings()) {
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            CAPTURE(seed);
            setting.reference = true;
            const auto expected = run(setting, seed);
            setting.reference = false;
            const auto served_together = run(setting, seed);
            REQUIRE(expected->receptions.size() > 300);
            REQUIRE(served_together->receptions == expected->receptions);
            REQUIRE(served_together->sendings == expected->sendings);
            CHECK(served_together->always_in_order);
        }
    }
}

TEST_CASE(
    "order: a routing protocol gets each batch of receptions in order, when the last reception "
    "ends") {
    const auto always_in_order = std::make_shared<bool>(true);
    Playground({}, 1).run(WatchedFlood{.always_in_order = always_in_order});
    CHECK(*always_in_order);
}

TEST_CASE("order: a run that is paused between receptions gives the same result") {
    const auto whole = Playground({}, 1).run(Flood{.jitter = 100us});
    const auto in_steps = Playground({}, 1).run(Flood{.jitter = 100us}, 1'777ns);
    CHECK(in_steps->receptions == whole->receptions);
    CHECK(in_steps->sendings == whole->sendings);
    CHECK(in_steps->always_in_order);
}

TEST_CASE("order: in reference mode receptions at different times are separate events") {
    Network net({.propagation = Disc{.range = {150}}, .reference = true, .metrics = false});
    net.route(Flood{.ttl = 1});
    for (const double x : {0.0, 10.0, 10.0, 20.0}) net.add({.name = {}, .at = {x, 0, 0}});
    net.send({0}, everyone, "hello");
    net.run_for(1s);
    CHECK(net.events() == 2);  // those of one time are one: no order of numbers is among them
}

TEST_CASE(
    "order: receptions are in order of time for few and many receivers, spread, in rings or in one "
    "place") {
    test::Draw draw(17);
    for (const bool delayed : {true, false}) {
        for (const int count : {2, 13, 60, 64, 65, 66, 67, 130, 400}) {
            for (const int rings : {0, 1, 3}) {
                Network net({.propagation = Disc{.range = 1000_m},
                             .propagation_delay = delayed,
                             .metrics = false});
                auto log = std::make_shared<ReceptionLog>();
                net.add_sink(Sink{log});
                net.route(Flood{.ttl = 1});
                for (int i = 0; i < count; ++i) {
                    const double r = rings > 0 ? i % rings * 80.0 : draw.uniform(0, 300);
                    const double angle = draw.uniform(0, 6.28);
                    net.add({.name = {}, .at = {r * std::cos(angle), r * std::sin(angle), 0}});
                }
                net.send({static_cast<std::uint32_t>(count / 2)}, everyone, "hello");
                net.run_for(1s);
                REQUIRE(log->receptions.size() == static_cast<std::size_t>(count - 1));
                REQUIRE(log->always_in_order);
            }
        }
    }
}

TEST_CASE("order: receivers light seconds away also receive in the order of time") {
    Network net({.propagation = Disc{.range = Meters{1e10}}});
    auto log = std::make_shared<ReceptionLog>();
    net.add_sink(Sink{log});
    net.route(Flood{.ttl = 1});
    for (const double x : {0.0, 3e9, 2e9, 2e9, 10.0}) net.add({.name = {}, .at = {x, 0, 0}});
    net.send({0}, everyone, "hello");
    net.run_for(60s);
    std::vector<NodeId> order;
    for (const auto& reception : log->receptions) order.push_back(std::get<NodeId>(reception));
    CHECK(order == std::vector{NodeId{4}, NodeId{2}, NodeId{3}, NodeId{1}});
}

TEST_CASE(
    "order: a robot can forward a frame at the very time at which the frame ends at another "
    "robot") {
    constexpr double microsecond = 299.792458;  // [m] at the speed of light
    Network net({.propagation = Disc{.range = Meters{1000}}});
    auto log = std::make_shared<ReceptionLog>();
    net.add_sink(Sink{log});
    net.route(Flood{.ttl = 2, .jitter = 0us});
    for (const double x : {0.0, microsecond, 2 * microsecond}) {
        net.add({.name = {}, .at = {x, 0, 0}});
    }
    net.send({0}, everyone, "hello");
    net.run_for(1s);
    CHECK(log->receptions.size() == 6);
}

}  // namespace order_test
