// SPDX-License-Identifier: MIT
// A Stage world with lasers and its configuration, served as to somebody who comes from Stage.
#include "test/live/live_command.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace stage_test {
using namespace rovernet::test;

namespace {

constexpr double degrees = std::numbers::pi / 180;  // [rad]

/// A room of 20 m x 10 m with a pillar, and two robots, in the words of Stage.
const std::string world = R"(define sicklaser laser ( samples 271 fov 270 range_max 12 )
define bot position ( size [0.5 0.4] wifi ( model "friis" ) )
model ( name "room" size [20 10] boundary 1 noblocks 1 )
model ( name "pillar" pose [3 1 0] size [1 2] )
bot ( name "r0" pose [-2 -1 20] sicklaser ( pose [0.2 -0.1 30] ) )
bot ( name "r1" pose [2 -3 0]
  ranger ( sensor ( pose [0 0 0 90] range [0 20] ) sensor ( pose [-0.1 0 0 180] range [0 20] ) ) )
)";

const std::string configuration = R"(
driver ( name "stage" plugin "stageplugin" provides [ "simulation:0" ] worldfile "room.world" )
driver ( name "stage" provides [ "6665:position2d:0" "6665:laser:0" ] model "r0" )
driver ( name "stage" provides [ "6666:position2d:0" "6666:ranger:0" ] model "r1" )
)";

struct Wall {
    double x0, y0, x1, y1;
};

/// The sides of a rectangle.
void append_sides(std::vector<Wall>& walls, double left, double low, double right, double high) {
    walls.insert(walls.end(), {{left, low, right, low},
                               {right, low, right, high},
                               {right, high, left, high},
                               {left, high, left, low}});
}

/// Way of a ray to the nearest wall or disc [m]: each is tried, by Cramer's rule or the quadratic
/// formula.
double brute_force(double x, double y, double angle, double disc_x, double disc_y, double radius,
                   double range) {
    std::vector<Wall> walls;
    append_sides(walls, -9.99, -4.99, 9.99, 4.99);  // the boundary is 1 cm thick, inside the size
    append_sides(walls, 2.5, 0, 3.5, 2);
    const double dx = std::cos(angle), dy = std::sin(angle);
    double way = range;
    for (const Wall& wall : walls) {
        const double ex = wall.x1 - wall.x0, ey = wall.y1 - wall.y0;
        const double determinant = ex * dy - ey * dx;
        if (std::abs(determinant) < 1e-12) continue;
        const double along = (ex * (wall.y0 - y) - ey * (wall.x0 - x)) / determinant;
        const double share = (dx * (wall.y0 - y) - dy * (wall.x0 - x)) / determinant;
        if (along >= 0 && share >= 0 && share <= 1) way = std::min(way, along);
    }
    const double fx = x - disc_x, fy = y - disc_y;
    const double b = fx * dx + fy * dy, c = fx * fx + fy * fy - radius * radius;
    if (b * b >= c && -b - std::sqrt(b * b - c) >= 0)
        way = std::min(way, -b - std::sqrt(b * b - c));
    return way;
}

/// Data of one device in the first round of a client in lock-step.
std::string data_of(LineClient& client, std::uint32_t interface) {
    CHECK(client.bytes(32).starts_with("Player v."));
    client.send_bytes(mode(pull) + device(interface, 0) + ask());
    for (int i = 0; i < 3; ++i) CHECK(message_of(client).type == ack);
    const Wire told = message_of(client);
    CHECK(told.type == data);
    CHECK(told.interface == interface);
    CHECK(told.subtype == 1);
    return told.payload;
}

}  // namespace

TEST_CASE(
    "stage: the laser and the ranger of a world are the devices laser:0 and ranger:0 of its "
    "configuration") {
    const TemporaryFolder folder;
    folder.write("room.world", world);
    const Process live(folder,
                       {"live", folder.write("room.cfg", configuration), "--player", "127.0.0.1:0",
                        "--player-lockstep", "--wait-for", "2", "--out", folder.path("out")});
    const auto port = [&](const std::string& robot) {
        return read_port(said(folder, "listening on 127.0.0.1:", "robot " + robot + ")"));
    };
    constexpr double tolerance = 1e-5;  // [m] of a float of 12 m
    LineClient first(port("r0")), second(port("r1"));
    CHECK(second.bytes(32).starts_with("Player v."));
    second.send_bytes(mode(pull) + device(62, 0) + ask());

    const std::string laser = data_of(first, 6);
    REQUIRE(laser.size() == 16 + 8 + 271 * 4 + 8 + 4);
    CHECK(float_at(laser, 0) == static_cast<float>(-135 * degrees));
    CHECK(float_at(laser, 4) == static_cast<float>(135 * degrees));
    CHECK(float_at(laser, 8) == static_cast<float>(1 * degrees));
    CHECK(float_at(laser, 12) == 12);
    const double heading = 20 * degrees;
    const double x = -2 + 0.2 * std::cos(heading) + 0.1 * std::sin(heading);
    const double y = -1 + 0.2 * std::sin(heading) - 0.1 * std::cos(heading);
    bool sees_nothing = false, sees_robot = false;
    for (int i = 0; i < 271; ++i) {
        const double angle = heading + (30 - 135 + i) * degrees;
        const double way = brute_force(x, y, angle, 2, -3, 0.2, 12);
        CAPTURE(i);
        CHECK(std::abs(float_at(laser, 24 + 4 * static_cast<std::size_t>(i)) - way) < tolerance);
        sees_nothing = sees_nothing || way == 12;
        sees_robot = sees_robot || way != brute_force(x, y, angle, 99, 99, 0.2, 12);
    }
    CHECK(sees_nothing);
    CHECK(sees_robot);

    for (int i = 0; i < 3; ++i) CHECK(message_of(second).type == ack);
    const std::string ranger = message_of(second).payload;
    REQUIRE(ranger.size() == 8 + 2 * 8);
    CHECK(std::abs(double_at(ranger, 8) - 7.99) < 1e-9);
    CHECK(std::abs(double_at(ranger, 16) - 11.89) < 1e-9);
    first.close();
    second.close();
    CHECK(live.wait().exit == 0);
}

}  // namespace stage_test
