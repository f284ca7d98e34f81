// SPDX-License-Identifier: MIT
// Receptions are put in order only for those who look at it, and nothing else may come of that.
#include "experiment/network.hpp"
#include "mobility/random_waypoint.hpp"
#include "models/list.hpp"
#include "routing/flood.hpp"
#include "test/experiment/reception_log.hpp"
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

using namespace rovernet;
using namespace rovernet::test;

namespace {

using namespace std::chrono_literals;

/// A flood that counts on the order.
struct OrderedFlood {
    FloodRouter flood{Flood{.jitter = 100us}};
    std::shared_ptr<bool> always_in_order;

    Hops initial_ttl() const { return flood.initial_ttl(); }
    void send(LinkLayer& link, NodeId node, MessageId m) { flood.send(link, node, m); }
    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        *always_in_order = *always_in_order && in_order(receptions);
        flood.on_receive(link, frame, receptions);
    }
    void on_timer(LinkLayer& link, NodeId node, std::uint64_t tag) {
        flood.on_timer(link, node, tag);
    }
    void forget(MessageId message) { flood.forget(message); }
};

/// A flood that takes any order, and looks at the clock: it is when the last of them came.
struct TimedFlood : OrderedFlood {
    static constexpr bool takes_any_order = true;

    void on_receive(LinkLayer& link, const Frame& frame, std::span<Reception> receptions) {
        REQUIRE(!receptions.empty());
        Time last = Time::min();
        for (const Reception& r : receptions) last = std::max(last, r.time);
        REQUIRE(link.now() == last);
        OrderedFlood::on_receive(link, frame, receptions);
    }
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
    std::shared_ptr<ReceptionLog> run(Router router, KindMask kinds, Duration step = 1s) {
        auto log = std::make_shared<ReceptionLog>(ReceptionLog{kinds});
        net.add_sink(Sink{log});
        net.route(std::move(router));
        for (std::uint32_t i = 0; i < robots; i += 6) {
            const auto begin = (i < robots / 2 ? i / 12 : i / 6) * 10ms;
            net.at(start_of_run + begin, [this, i] { net.broadcast({i}, "hello"); });
        }
        while (net.now() < start_of_run + 1s) {
            log->end_of_run = net.now() + step;
            net.run_for(step);
        }
        return log;
    }
};

std::shared_ptr<ReceptionLog> run(const Setting& setting, std::uint32_t seed, KindMask kinds) {
    return Playground(setting, seed).run(setting.flood, kinds);
}

}  // namespace

TEST_CASE("any order: the same happens as when each reception is an event, whoever looks") {
    std::size_t unordered = 0;
    for (Setting setting : settings()) {
        for (std::uint32_t seed = 1; seed <= 4; ++seed) {
            CAPTURE(seed);
            setting.reference = true;
            const auto expected = run(setting, seed, ordered);
            setting.reference = false;
            const auto all = run(setting, seed, any_order);
            const auto in_order = run(setting, seed, ordered);
            REQUIRE(expected->receptions.size() > 300);
            REQUIRE(all->sorted() == expected->sorted());
            REQUIRE(all->sendings == expected->sendings);
            REQUIRE(in_order->receptions == expected->receptions);
            REQUIRE(in_order->sendings == expected->sendings);
            CHECK(in_order->always_in_order);
            unordered += !all->always_in_order;
        }
    }
    CHECK(unordered > 10);  // or this tests nothing
}

TEST_CASE("any order: a router that does not say that it takes any gets receptions in order") {
    const auto always_in_order = std::make_shared<bool>(true);
    Playground ground({}, 1);
    ground.run(OrderedFlood{.always_in_order = always_in_order}, any_order);
    CHECK(*always_in_order);
}

TEST_CASE("any order: the clock shows when the last of those that are served together came") {
    const auto always_in_order = std::make_shared<bool>(true);
    Playground ground({}, 1);
    TimedFlood flood;
    flood.always_in_order = always_in_order;
    ground.run(std::move(flood), any_order);
    CHECK(!*always_in_order);
}

TEST_CASE("any order: a run that stops between receptions and goes on is the same run") {
    for (const KindMask kinds : {ordered, any_order}) {
        const auto whole = Playground({}, 1).run(Flood{.jitter = 100us}, kinds);
        const auto in_steps = Playground({}, 1).run(Flood{.jitter = 100us}, kinds, 1'777ns);
        CHECK(in_steps->sorted() == whole->sorted());
        CHECK(in_steps->sendings == whole->sendings);
        CHECK(in_steps->always_in_order == (kinds == ordered));
    }
}

TEST_CASE("any order: in reference mode receptions at different times are events of their own") {
    Network net({.propagation = Disc{.range = {150}}, .reference = true, .metrics = false});
    net.route(Flood{.ttl = 1});
    for (const double x : {0.0, 10.0, 10.0, 20.0}) net.add({.name = {}, .at = {x, 0, 0}});
    net.broadcast({0}, "hello");
    net.run_for(1s);
    CHECK(net.events() == 2);  // those of one time are one: no order of numbers is among them
}

TEST_CASE("any order: one sink that wants the order gets it beside others that do not") {
    for (const bool first : {true, false}) {
        Playground ground({}, 1);
        auto wants = std::make_shared<ReceptionLog>(ReceptionLog{ordered});
        if (first) ground.net.add_sink(Sink{wants});
        if (!first) ground.net.at(start_of_run + 1ms, [&] { ground.net.add_sink(Sink{wants}); });
        ground.run(Flood{.jitter = 100us}, any_order);
        CHECK(wants->receptions.size() > 300);
        CHECK(wants->always_in_order);
    }
}

TEST_CASE("any order: few and many receivers are in order, spread, in rings or all in one place") {
    test::Draw draw(17);
    for (const bool delayed : {true, false}) {
        for (const int count : {2, 13, 60, 64, 65, 66, 67, 130, 400}) {
            for (const int rings : {0, 1, 3}) {
                Network net({.propagation = Disc{.range = 1000_m},
                             .propagation_delay = delayed,
                             .metrics = false});
                auto log = std::make_shared<ReceptionLog>(ReceptionLog{ordered});
                net.add_sink(Sink{log});
                net.route(Flood{.ttl = 1});
                for (int i = 0; i < count; ++i) {
                    const double r = rings > 0 ? i % rings * 80.0 : draw.uniform(0, 300);
                    const double angle = draw.uniform(0, 6.28);
                    net.add({.name = {}, .at = {r * std::cos(angle), r * std::sin(angle), 0}});
                }
                net.broadcast({static_cast<std::uint32_t>(count / 2)}, "hello");
                net.run_for(1s);
                REQUIRE(log->receptions.size() == static_cast<std::size_t>(count - 1));
                REQUIRE(log->always_in_order);
            }
        }
    }
}

TEST_CASE("any order: receivers that are light seconds away are in order, too") {
    Network net({.propagation = Disc{.range = Meters{1e10}}});
    auto log = std::make_shared<ReceptionLog>(ReceptionLog{ordered});
    net.add_sink(Sink{log});
    net.route(Flood{.ttl = 1});
    for (const double x : {0.0, 3e9, 2e9, 2e9, 10.0}) net.add({.name = {}, .at = {x, 0, 0}});
    net.broadcast({0}, "hello");
    net.run_for(60s);
    std::vector<NodeId> order;
    for (const auto& reception : log->receptions) order.push_back(std::get<NodeId>(reception));
    CHECK(order == std::vector{NodeId{4}, NodeId{2}, NodeId{3}, NodeId{1}});
}
