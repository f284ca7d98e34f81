// SPDX-License-Identifier: MIT
#include "live/player/position2d.hpp"

namespace rovernet {
namespace {

enum Position2dRequest : std::uint32_t {
    tell_geometry = 1,
    switch_motors = 2,
    set_odometry = 5,
    reset_odometry = 6,
};
constexpr std::uint32_t set_velocity = 1;  // command

}  // namespace

std::vector<std::string> PlayerPosition2d::data() {
    const Pose2d pose = robot_.odometry();
    const Twist twist = robot_.session().twist(robot_.id());
    return {XdrWriter()
                .f64s(std::vector{pose.x, pose.y, pose.heading, twist.speed, 0.0, twist.turn_rate})
                .u32(robot_.session().is_stalled(robot_.id()) ? 1 : 0)
                .take()};
}

std::optional<std::string> PlayerPosition2d::answer(std::uint32_t subtype, XdrReader payload) {
    constexpr double farthest = 1e9;  // [m], [rad]
    constexpr double height = 0.3;    // [m]
    switch (subtype) {
        case tell_geometry: {
            const double width = 2 * robot_.radius();
            return XdrWriter().zeros(48).f64s(std::vector{width, width, height}).take();
        }
        case set_odometry: {
            const double x = payload.f64_within(farthest), y = payload.f64_within(farthest);
            robot_.set_odometry({x, y, payload.f64_within(farthest)});
            return "";
        }
        case reset_odometry: robot_.set_odometry({}); return "";
        case switch_motors: return "";
        default: return std::nullopt;
    }
}

void PlayerPosition2d::command(std::uint32_t subtype, XdrReader payload) {
    if (subtype != set_velocity) return;
    const double speed = payload.f64_within(drive_speeds.high);
    payload.f64();  // sideways: its wheels cannot
    robot_.carry_out(DriveCommand{{speed}, {payload.f64_within(drive_turns.high)}});
}

}  // namespace rovernet
