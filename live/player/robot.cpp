// SPDX-License-Identifier: MIT
#include "live/player/robot.hpp"

#include "sim/math.hpp"

namespace rovernet {

PlayerRobot::PlayerRobot(Session& session, NodeId robot)
    : session_(session),
      id_(robot),
      radius_(session.network().robot(robot).radius.value),
      origin_(pose()) {}

/// Makes this client the robot's driver. @return whether it is
bool PlayerRobot::take() {
    if (!client_ && !session_.driver(id_)) {
        client_ = session_.attach({id_}, "player", listens_);
    }
    return client_.has_value();
}

void PlayerRobot::carry_out(const RobotCommand& command) {
    if (!take()) return;
    is_driven_ = true;
    session_.carry_out(*client_, id_, command, ++commands_);
}

void PlayerRobot::release() {
    if (!is_driven_) return;
    is_driven_ = false;
    if (listens_) {
        session_.carry_out(*client_, id_, StopCommand{}, ++commands_);
    } else {
        session_.detach(*client_);
        client_.reset();
    }
}

void PlayerRobot::listen(bool listens) {
    listens_ = listens;
    if (listens) take();
    if (client_) session_.set_hearing(*client_, listens);
}

std::vector<HeardMessage> PlayerRobot::heard() {
    return take() ? session_.heard(*client_) : std::vector<HeardMessage>{};
}

Pose2d PlayerRobot::pose() const {
    const Vec3 at = session_.network().position(id_);
    return {at.x, at.y, session_.network().heading(id_).value};
}

Pose2d PlayerRobot::odometry() const {
    const Pose2d here = pose();
    const auto [sin, cos] = math::sincos(origin_.heading);
    const double dx = here.x - origin_.x, dy = here.y - origin_.y;
    return {cos * dx + sin * dy, cos * dy - sin * dx, wrapped(here.heading - origin_.heading)};
}

void PlayerRobot::set_odometry(const Pose2d& now) {
    const Pose2d here = pose();
    origin_.heading = wrapped(here.heading - now.heading);
    const auto [sin, cos] = math::sincos(origin_.heading);
    origin_.x = here.x - (cos * now.x - sin * now.y);
    origin_.y = here.y - (sin * now.x + cos * now.y);
}

}  // namespace rovernet
