// SPDX-License-Identifier: MIT
// What a Network does with movements: turning, top speeds, being put elsewhere.
#include "mobility/patrol.hpp"
#include "mobility/waypoints.hpp"
#include "models/propagation/disc.hpp"
#include "network/network.hpp"
#include "routing/flood.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

namespace motion_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr double pi_ = 3.14159265358979323846;
/// A few roundings of coordinates and angles up to 100.
constexpr double tolerance = 1e-9;

bool near(double a, double b) { return std::abs(a - b) <= tolerance; }
bool near(Vec3 a, Vec3 b) { return distance(a, b) <= tolerance; }

struct Diary {
    std::vector<Moved> moves = {};
    std::vector<Arrived> arrivals = {};
    KindMask kinds() const { return kind_of<Moved>() | kind_of<Arrived>(); }
    void on(const Record& record, const RecordContext&) {
        if (const auto* m = std::get_if<Moved>(&record)) moves.push_back(*m);
        if (const auto* a = std::get_if<Arrived>(&record)) arrivals.push_back(*a);
    }
};

/// Goes 10 m north, then 10 m west, at 1 m/s.
Robot surveyor() {
    return {.name = "s",
            .at = {},
            .move = Waypoints{.path = {{0, 10, 0}, {-10, 10, 0}}},
            .turn_rate = RadiansPerSecond{pi_ / 4}};
}

}  // namespace

TEST_CASE("motion: a turn in place lasts the angle divided by the turn rate, and is recorded") {
    Network net;
    const auto diary = std::make_shared<Diary>();
    net.add_sink(diary);
    const NodeId s = net.add(surveyor());
    net.run_until(start_of_run + 1s);
    CHECK(near(net.position(s), Vec3{}));
    CHECK(near(net.heading(s).value, pi_ / 4));
    net.run_until(start_of_run + 7s);
    CHECK(near(net.position(s), Vec3{0, 5, 0}));
    CHECK(near(net.heading(s).value, pi_ / 2));
    net.run_until(start_of_run + 13s);
    CHECK(near(net.heading(s).value, 3 * pi_ / 4));
    net.run_until(start_of_run + 30s);
    REQUIRE(diary->moves.size() == 4);  // turn, go, turn, go
    CHECK(near(diary->moves[0].leg.turning, pi_ / 4));
    CHECK(near(diary->moves[2].leg.heading, pi_ / 2));
    REQUIRE(diary->arrivals.size() == 1);
    CHECK(near(seconds(diary->arrivals[0].time), 24));
    CHECK(near(net.heading(s).value, pi_) + near(net.heading(s).value, -pi_) == 1);
}

TEST_CASE("motion: a robot turns the shorter way round, also across the heading of 180 degrees") {
    Network net;
    const NodeId s = net.add({.name = "s",
                              .at = {},
                              .move = ToGoal{.to = {-10, -1, 0}},
                              .heading = Radians{3},
                              .turn_rate = RadiansPerSecond{1}});
    const double way = std::atan2(-1, -10) + 2 * pi_ - 3;  // from 3 rad on, counter-clockwise
    REQUIRE(way > 0);
    net.run_until(start_of_run + std::chrono::milliseconds(100));
    CHECK(near(net.heading(s).value, 3.1));
    net.run_until(start_of_run + from_seconds(way + 1));
    CHECK(std::abs(distance(net.position(s), {}) - 1) < 1e-6);
}

TEST_CASE("motion: a robot switched off while it turns continues the turn later") {
    Network net;
    const NodeId s = net.add(surveyor());
    net.run_until(start_of_run + 1s);
    net.switch_off(s);
    net.run_until(start_of_run + 6s);
    CHECK(near(net.heading(s).value, pi_ / 4));
    net.switch_on(s);
    net.run_until(start_of_run + 6500ms);
    CHECK(near(net.heading(s).value, 3 * pi_ / 8));
    net.run_until(start_of_run + 7s);
    CHECK(near(net.heading(s).value, pi_ / 2));
    net.run_until(start_of_run + 12s);
    CHECK(near(net.position(s), Vec3{0, 5, 0}));
}

TEST_CASE("motion: with or without times for the goals, no robot exceeds its top speed") {
    Network net;
    const NodeId slow = net.add({.name = "slow",
                                 .at = {},
                                 .move = ToGoal{.to = {10, 0, 0}, .speed = {5}},
                                 .top_speed = {2}});
    const NodeId late = net.add({.name = "late",
                                 .at = {},
                                 .move = Waypoints{.timed = {{2s, {10, 0, 0}}}},
                                 .top_speed = {2}});
    net.run_until(start_of_run + 2s);
    CHECK(near(net.position(slow), Vec3{4, 0, 0}));
    CHECK(near(net.position(late), Vec3{4, 0, 0}));
    net.run_until(start_of_run + 5s);
    CHECK(near(net.position(late), Vec3{10, 0, 0}));
}

TEST_CASE("motion: a robot placed elsewhere rests there, and a stopped robot rests where it is") {
    Network net;
    const NodeId a = net.add({.name = "a", .at = {}, .move = ToGoal{.to = {100, 0, 0}}});
    net.run_until(start_of_run + 10s);
    net.stop(a);
    net.run_until(start_of_run + 20s);
    CHECK(near(net.position(a), Vec3{10, 0, 0}));
    net.move(a, ToGoal{.to = {0, 0, 0}});
    net.run_until(start_of_run + 21s);
    net.place(a, {50, 50, 0});
    CHECK(near(net.position(a), Vec3{50, 50, 0}));
    net.run_until(start_of_run + 60s);
    CHECK(near(net.position(a), Vec3{50, 50, 0}));
}

TEST_CASE("motion: invalid parameters of a robot are refused") {
    Network net;
    CHECK_THROWS_AS(net.add({.name = "a", .at = {}, .top_speed = {0}}), std::invalid_argument);
    CHECK_THROWS_AS(net.add({.name = "b", .at = {}, .turn_rate = RadiansPerSecond{-1}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(net.add({.name = "c", .at = {}, .heading = {std::nan("")}}),
                    std::invalid_argument);
    CHECK(net.size() == 0);
}

TEST_CASE("links: the callback for a lost link is called 1 us after the link is lost") {
    Network net({.propagation = Disc{.range = Meters{50}}});
    const NodeId base = net.add({.name = "base", .at = {}});
    const NodeId rover =
        net.add({.name = "rover", .at = {40, 0, 0}, .move = ToGoal{.to = {100, 0, 0}}});
    std::vector<Time> lost;
    net.on_link_lost(rover, [&](NodeId from) {
        CHECK(from == base);
        lost.push_back(net.now());
        net.move(rover, ToGoal{.to = {45, 0, 0}});
    });
    net.run_until(start_of_run + 60s);
    REQUIRE(lost.size() == 1);
    CHECK(std::abs(seconds(lost[0]) - 10 - 1e-6) < 1e-8);
    CHECK(near(net.position(rover), Vec3{45, 0, 0}));
    REQUIRE(net.links(rover, net.now()).size() == 1);
    CHECK(net.links(rover, net.now())[0].node == base);
}

TEST_CASE("links: every link change is recorded once, in the order of time") {
    struct Book {
        std::vector<std::pair<double, bool>> changes = {};
        KindMask kinds() const { return kind_links; }
        void on(const Record& record, const RecordContext&) {
            if (const auto* u = std::get_if<LinkUp>(&record)) {
                changes.emplace_back(seconds(u->time), true);
            }
            if (const auto* d = std::get_if<LinkDown>(&record)) {
                changes.emplace_back(seconds(d->time), false);
            }
        }
    };
    Network net({.propagation = Disc{.range = Meters{10}}});
    const auto book = std::make_shared<Book>();
    net.add_sink(book);
    net.add({.name = "post", .at = {0, 5, 0}, .radio = {.antenna_height = Meters{0}}});
    const NodeId walker = net.add({.name = "walker",
                                   .at = {-100, 0, 0},
                                   .radio = {.antenna_height = Meters{0}},
                                   .move = ToGoal{.to = {100, 0, 0}}});
    net.at(start_of_run + 100s, [&] { net.switch_off(walker); });
    net.at(start_of_run + 101s, [&] { net.switch_on(walker); });
    net.run_until(start_of_run + 300s);
    // Both directions: up at 91.34 s, down and up by the switch, down at 108.66 s and a second.
    REQUIRE(book->changes.size() == 8);
    const double half = std::sqrt(75);
    constexpr double a_nanosecond = 2e-9;
    for (const auto& [i, t] : {std::pair{0, 100 - half}, {2, 100.0}, {4, 101.0}, {6, 101 + half}}) {
        CHECK(std::abs(book->changes[static_cast<std::size_t>(i)].first - t) < a_nanosecond);
        CHECK(book->changes[static_cast<std::size_t>(i)].second == (i == 0 || i == 4));
    }
}

TEST_CASE("links: movements that were replaced leave no events behind") {
    struct Watcher {
        KindMask kinds() const { return kind_links; }
        void on(const Record&, const RecordContext&) {}
    };
    Network net({.propagation = Disc{.range = Meters{10}}});
    net.add_sink(Watcher{});
    net.add({.name = "a", .at = {}});
    const NodeId b = net.add({.name = "b", .at = {-100, 0, 0}});
    constexpr int plans = 200;
    for (int i = 0; i < plans; ++i) {
        net.at(start_of_run + std::chrono::milliseconds(10 * i), [&net, b, i] {
            // Each plan brings the next change nearer; the last one has many.
            net.move(b, Patrol{.path = {{100, 0, 0}, {-100, 0, 0}}, .speed = {1 + 0.1 * i}});
        });
    }
    net.run_until(start_of_run + 300s);
    CHECK(net.events() < 4 * plans);  // an action each, a look each, and a few more
}

TEST_CASE(
    "links: link changes are searched only if a sink (a listener to records) wants link changes") {
    struct Watcher {
        KindMask kinds() const { return kind_links; }
        void on(const Record&, const RecordContext&) {}
    };
    const auto events = [](bool watch) {
        Network net({.propagation = Disc{.range = Meters{10}}});
        if (watch) net.add_sink(Watcher{});
        net.add({.name = "a", .at = {}});
        net.add({.name = "b", .at = {-100, 0, 0}, .move = ToGoal{.to = {100, 0, 0}}});
        net.run_until(start_of_run + 300s);
        return net.events();
    };
    CHECK(events(false) == 1);  // the end of the leg
    CHECK(events(true) > 1);
}

}  // namespace motion_test
