// SPDX-License-Identifier: MIT
#include "live/player/simulation.hpp"

namespace rovernet {
namespace {

enum SimulationRequest : std::uint32_t {
    tell_pose2d = 1,
    set_pose2d = 2,
    tell_pose3d = 3,
    set_pose3d = 4,
};
constexpr double farthest = goal_places.high;  // [m], [rad]

std::string answer_pose2d(const std::string& name, const PlayerRobot& robot) {
    const Pose2d pose = robot.pose();
    return XdrWriter().text(name).f64(pose.x).f64(pose.y).f64(pose.heading).take();
}

std::string answer_pose3d(const std::string& name, const PlayerRobot& robot) {
    const Network& network = robot.session().network();
    const Pose2d pose = robot.pose();
    return XdrWriter()
        .text(name)
        .f64s(std::vector{pose.x, pose.y, network.position(robot.id()).z})
        .f64s(std::vector{0.0, 0.0, pose.heading})  // roll, pitch, yaw
        .f64(seconds(network.now()))
        .take();
}

PlaceCommand read_place2d(XdrReader& payload, const PlayerRobot& robot) {
    const double x = payload.f64_within(farthest), y = payload.f64_within(farthest);
    const double z = robot.session().network().position(robot.id()).z;
    return {{x, y, z}, {payload.f64_within(farthest)}};
}

PlaceCommand read_place3d(XdrReader& payload) {
    const double x = payload.f64_within(farthest), y = payload.f64_within(farthest);
    const double z = payload.f64_within(farthest);
    payload.f64();  // roll
    payload.f64();  // pitch
    return {{x, y, z}, {payload.f64_within(farthest)}};
}

/// Puts a robot there; refused where there is no room.
std::optional<std::string> put(PlayerRobot& robot, const PlaceCommand& place) {
    if (!robot.session().why_not(robot.id(), place).empty()) return std::nullopt;
    robot.carry_out(place);
    return "";
}

}  // namespace

std::optional<std::string> PlayerSimulation::answer(std::uint32_t subtype, XdrReader payload) {
    if (subtype < tell_pose2d || subtype > set_pose3d) return std::nullopt;
    const auto found = robots_.find(payload.text());
    if (found == robots_.end()) return std::nullopt;
    const auto& [name, robot] = *found;
    switch (subtype) {
        case tell_pose2d: return answer_pose2d(name, *robot);
        case tell_pose3d: return answer_pose3d(name, *robot);
        case set_pose2d: return put(*robot, read_place2d(payload, *robot));
        default: return put(*robot, read_place3d(payload));
    }
}

}  // namespace rovernet
