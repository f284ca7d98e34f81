// SPDX-License-Identifier: MIT
// Driving by velocity, beside the exact arc.
#include "mobility/driven.hpp"

#include "network/network.hpp"
#include "test/scene/drawn_map.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <memory>

namespace driven_test {
using namespace rovernet;
using namespace std::chrono_literals;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Where somebody is who began at `from` facing `a`, after `t` seconds at v and w.
Vec3 on_arc(Vec3 from, double a, double v, double w, double t) {
    if (w == 0) return from + v * t * Vec3{std::cos(a), std::sin(a), 0};
    return from +
           v / w * Vec3{std::sin(a + w * t) - std::sin(a), std::cos(a) - std::cos(a + w * t), 0};
}

/// Counts the legs of a run.
struct Legs_ {
    int count = 0;
    KindMask kinds() const { return kind_of<Moved>(); }
    void on(const Record&, const RecordContext&) { ++count; }
};

struct Drive {
    Network net;
    NodeId robot;
    std::shared_ptr<Legs_> legs = std::make_shared<Legs_>();

    explicit Drive(double heading = 0, std::optional<RadiansPerSecond> turn_rate = {},
                   NetworkSettings settings = {}, Vec3 at = {5, 7, 0})
        : net(std::move(settings)),
          robot(net.add({.name = "r",
                         .at = at,
                         .radius = {0.2},
                         .heading = {heading},
                         .turn_rate = turn_rate})) {
        net.add_sink(legs);
        net.run_for(1s);
        legs->count = 0;
    }
    double heading() const { return net.heading(robot).value; }
};

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * pi)); }

}  // namespace

TEST_CASE(
    "driven: the position is at most a millimetre off the commanded arc; the heading is exact") {
    for (const double v : {1.0, 0.3, -2.0}) {
        for (const double w : {1.0, -0.1, 3.0, 0.0}) {
            for (const bool turns_in_place : {false, true}) {
                CAPTURE(v);
                CAPTURE(w);
                const double a = 0.7;
                Drive drive(a, turns_in_place ? std::optional(RadiansPerSecond{2}) : std::nullopt);
                drive.net.move(drive.robot, Driven{.speed = {v}, .turn_rate = {w}});
                double worst = 0, off = 0;
                for (int step = 1; step <= 1000; ++step) {
                    drive.net.run_for(7ms);
                    const double t = 0.007 * step;
                    worst = std::max(worst, distance(drive.net.position(drive.robot),
                                                     on_arc({5, 7, 0}, a, v, w, t)));
                    off = std::max(off, turn_between(drive.heading(), a + w * t));
                }
                CHECK(worst < 0.00101);
                CHECK(off < 1e-9);
                if (w == 0) CHECK(drive.legs->count == 1);
            }
        }
    }
}

TEST_CASE(
    "driven: at 1 m/s and 1 rad/s, an arc consists of about eleven straight legs per second") {
    Drive drive;
    drive.net.move(drive.robot, Driven{.speed = {1}, .turn_rate = {1}});
    drive.net.run_for(10s);
    CHECK(drive.legs->count >= 110);
    CHECK(drive.legs->count <= 114);
    CHECK(distance(drive.net.position(drive.robot), on_arc({5, 7, 0}, 0, 1, 1, 10)) < 0.00101);
}

TEST_CASE("driven: a robot can turn in place, and stands still after the end of a command") {
    Drive drive;
    drive.net.move(drive.robot, Driven{.turn_rate = {0.5}});
    drive.net.run_for(4s);
    CHECK(turn_between(drive.heading(), 2.0) < 1e-12);
    CHECK(drive.net.position(drive.robot) == Vec3{5, 7, 0});
    CHECK(drive.legs->count == 1);
    drive.net.move(drive.robot, Driven{.speed = {2}, .until = drive.net.now() + 1500ms});
    drive.net.run_for(10s);
    const Vec3 stop = on_arc({5, 7, 0}, 2.0, 2, 0, 1.5);
    CHECK(distance(drive.net.position(drive.robot), stop) < 1e-9);
}

TEST_CASE("driven: no command makes a robot faster than its top speed") {
    Network net;
    const NodeId robot = net.add({.name = "r", .at = {}, .top_speed = {0.5}});
    net.move(robot, Driven{.speed = {3}});
    net.run_for(2s);
    CHECK(distance(net.position(robot), {1, 0, 0}) < 1e-9);
}

TEST_CASE("driven: a robot stops at a wall, turns there, and drives on as soon as possible") {
    NetworkSettings settings;
    settings.scene =
        std::make_shared<const Scene>(test::drawn_map({"......#", "......#", "......#"}));
    Drive drive(0, {}, settings, {2, 1.5, 0});
    drive.net.move(drive.robot, Driven{.speed = {1}});
    drive.net.run_for(60s);
    const Vec3 at_wall = drive.net.position(drive.robot);
    CHECK(at_wall.x < 5.8);
    CHECK(at_wall.x > 5.8 - 2e-6);
    CHECK(at_wall.y == 1.5);
    // Blocked, it turns at the commanded rate, and follows the arc once it points away.
    drive.net.move(drive.robot, Driven{.speed = {0.2}, .turn_rate = {0.5}});
    drive.net.run_for(2s);
    CHECK(turn_between(drive.heading(), 1.0) < 1e-9);
    drive.net.move(drive.robot, Driven{.turn_rate = {pi - 1.0}});
    drive.net.run_for(1s);
    drive.net.move(drive.robot, Driven{.speed = {1}});
    drive.net.run_for(2s);
    CHECK(drive.net.position(drive.robot).x < 4);
    const auto& scene = *settings.scene;
    CHECK(scene.clearance(drive.net.position(drive.robot)) >= 0.2 - 1e-9);
}

TEST_CASE(
    "driven: after a thousand commands the position is no further off the arc than after one "
    "command") {
    Drive drive;
    const auto arc = std::make_shared<DrivenArc>();
    double worst = 0;
    for (int command = 0; command < 1000; ++command) {
        drive.net.move(drive.robot, Driven{.speed = {1}, .turn_rate = {1}, .arc = arc});
        for (int look = 1; look <= 13; ++look) {
            drive.net.run_for(1ms);
            const double t = 0.013 * command + 0.001 * look;
            worst = std::max(
                worst, distance(drive.net.position(drive.robot), on_arc({5, 7, 0}, 0, 1, 1, t)));
        }
    }
    CHECK(worst < 0.00101);
    CHECK(worst > 1e-5);
    // An arc of somebody who is elsewhere is no place to begin.
    drive.net.place(drive.robot, {0, 0, 0});
    drive.net.move(drive.robot, Driven{.speed = {1}, .arc = arc});
    const double a = drive.heading();
    drive.net.run_for(1s);
    CHECK(distance(drive.net.position(drive.robot), on_arc({0, 0, 0}, a, 1, 0, 1)) < 1e-9);
}

TEST_CASE("driven: at very small turn rates the path is still the right arc") {
    for (const double w : {1e-300, 1e-15, 1e-9, 1e-6, 1e-4}) {
        CAPTURE(w);
        Drive drive(0.3);
        drive.net.move(drive.robot, Driven{.speed = {2}, .turn_rate = {w}});
        drive.net.run_for(100s);
        // To the second order of w t, which is at most 0.01.
        const double s = 200, bend = w * 100;
        const Vec3 along = s * (1 - bend * bend / 6) * Vec3{std::cos(0.3), std::sin(0.3), 0};
        const Vec3 aside = s * bend / 2 * Vec3{-std::sin(0.3), std::cos(0.3), 0};
        CHECK(distance(drive.net.position(drive.robot), Vec3{5, 7, 0} + along + aside) < 0.00101);
    }
}

}  // namespace driven_test
