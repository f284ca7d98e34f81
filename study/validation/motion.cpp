// SPDX-License-Identifier: MIT
#include "mobility/driven.hpp"
#include "mobility/random_waypoint.hpp"
#include "network/network.hpp"
#include "scene/scene.hpp"
#include "sim/legs.hpp"
#include "sim/math.hpp"
#include "study/validation/cases/drawn_map.hpp"
#include "study/validation/validation_charts.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

// Where robots are, against closed forms.

namespace rovernet {
namespace {

constexpr int robots = 2000;

/// Largest error of the mean speed and of the share at rest of robots on the move, over what they
/// are in the steady state, at three times.
void check_random_waypoint(Promises& promises) {
    constexpr double side = 100, slow = 0.5, fast = 2, pause = 20;  // [m], [m/s], [s]
    constexpr double mean_way = 0.5214054331647207 * side;          // between uniform places
    const double inverse_speed = math::log(fast / slow) / (fast - slow);
    const double trip = mean_way * inverse_speed;
    const double at_rest = pause / (pause + trip), moving_speed = 1 / inverse_speed;
    Network network;
    for (int i = 0; i < robots; ++i)
        network.add({.name = "r" + std::to_string(i),
                     .at = {},
                     .move = RandomWaypoint{.area = {{0, 0}, {side, side}},
                                            .min_speed = {slow},
                                            .max_speed = {fast},
                                            .pause = std::chrono::seconds{20}}});
    double worst_speed = 0, worst_rest = 0;
    for (const double t : {0.0, 30.0, 300.0}) {
        network.run_until(start_of_run + from_seconds(t));
        double speeds = 0, rests = 0;
        for (std::uint32_t i = 0; i < robots; ++i) {
            const double speed = distance(network.legs().leg({i}).velocity, {});
            speeds += speed;
            rests += speed == 0;
        }
        const double moving = robots - rests;
        worst_speed = std::max(worst_speed, std::abs(speeds / moving / moving_speed - 1));
        worst_rest = std::max(worst_rest, std::abs(rests / robots - at_rest));
    }
    promises.push_back({"mean speed under random waypoint, against (max - min) / ln(max / min)", "",
                        0.035, worst_speed, 3});
    promises.push_back(
        {"share of robots at rest under random waypoint, against E[P] / (E[P] + E[T]) for pauses "
         "of P and trips of T seconds",
         "", 0.032, worst_rest, 3});
}

/// Command of a robot on an arc: turning left, from heading 0.
struct ArcCommand {
    double speed, turn_rate;  // [m/s], [rad/s]

    double radius() const { return speed / turn_rate; }
    /// Place so long after the start at the origin [m].
    Vec3 free(double t) const {
        const auto [sine, cosine] = math::sincos(turn_rate * t);
        return {radius() * sine, radius() * (1 - cosine), 0};
    }
    /// Place likewise of a robot whose middle cannot come farther than y = `wall`: it turns there
    /// until it heads along the wall, and leaves it on an arc.
    Vec3 beside(double wall, double t) const {
        const double cosine_there = 1 - wall / radius();
        const double contact =
            math::atan2(std::sqrt(1 - cosine_there * cosine_there), cosine_there) / turn_rate;
        if (t <= contact) return free(t);
        const Vec3 touch = free(contact);
        const double leaving = std::numbers::pi / turn_rate;
        if (t <= leaving) return {touch.x, wall, 0};
        const auto [sine, cosine] = math::sincos(turn_rate * (t - leaving));
        return {touch.x - radius() * sine, wall - radius() * (1 - cosine), 0};
    }
};

constexpr std::array commands{ArcCommand{1, 1}, ArcCommand{0.3, 0.2}, ArcCommand{2, 0.7},
                              ArcCommand{0.5, 3}};

/// Largest distance of a driven robot from where its command brings it.
void check_arcs(Promises& promises) {
    constexpr double cell = 0.1, wide = 20;
    const Vec3 begin{wide / 2, 3, 0};
    double free = 0, at_wall = 0;
    std::size_t cases = 0;
    for (const ArcCommand& command : commands) {
        // The wall is beyond a third of the circle's top, at a whole number of cells.
        const double room = std::floor(command.radius() / cell) * cell, body = 0.2;
        const double wall = begin.y + room + body;
        NetworkSettings settings;
        settings.scene = std::make_shared<const Scene>(
            drawn_map(wide, wide, cell, [&](Vec3 p) { return p.y > wall; }));
        for (const bool walled : {false, true}) {
            Network network(walled ? settings : NetworkSettings{});
            const NodeId robot = network.add({.name = "r", .at = begin, .radius = Meters{body}});
            network.move(robot, Driven{.speed = {command.speed}, .turn_rate = {command.turn_rate}});
            for (int step = 1; step <= 200; ++step) {
                const double t = 0.05 * step * std::numbers::pi / command.turn_rate / 4;
                network.run_until(start_of_run + from_seconds(t));
                const Vec3 expected = begin + (walled ? command.beside(room, t) : command.free(t));
                const double off = distance(network.position(robot), expected);
                (walled ? at_wall : free) = std::max(walled ? at_wall : free, off);
                cases += walled;
            }
        }
    }
    promises.push_back(
        {"position of a driven robot, against the exact circle", "m", 0.00101, free, cases});
    promises.push_back(
        {"position of a driven robot that turns at a wall, against the exact circles", "m", 0.0011,
         at_wall, cases});
}

}  // namespace

void check_motion(Promises& promises) {
    check_random_waypoint(promises);
    check_arcs(promises);
}

}  // namespace rovernet
