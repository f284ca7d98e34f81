// SPDX-License-Identifier: MIT
#include "experiment/driven_robots.hpp"

#include "mobility/waypoints.hpp"
#include "sim/legs.hpp"

#include <cmath>
#include <utility>

namespace rovernet {
namespace {

/// Position without a robot, for an arc that no robot follows.
constexpr Vec3 not_driven{1e300, 0, 0};

}  // namespace

DrivenRobots::DrivenRobots(Network& network) : network_(network) { network_.add_sink(no_ways_); }

/// Forgets the last command of a robot.
void DrivenRobots::forget(NodeId robot) {
    no_ways_->robots.erase(robot);
    driving_.erase(robot);
}

void DrivenRobots::drive(NodeId robot, MetersPerSecond speed, RadiansPerSecond turn_rate,
                         std::optional<Duration> timeout) {
    no_ways_->robots.erase(robot);
    Driven driven{.speed = speed, .turn_rate = turn_rate};
    if (timeout) driven.until = network_.now() + *timeout;
    Driving& driving = driving_[robot];
    if (!driving.arc) driving.arc = std::make_shared<DrivenArc>(DrivenArc{.at = not_driven});
    driving.until = driven.until.value_or(never);
    driving.speed = speed.value;
    driven.arc = driving.arc;
    network_.move(robot, driven);
}

void DrivenRobots::go(NodeId robot, Vec3 to, MetersPerSecond speed) {
    move(robot, ToGoal{to, speed});
}

void DrivenRobots::stop(NodeId robot) {
    forget(robot);
    network_.stop(robot);
}

void DrivenRobots::place(NodeId robot, Vec3 at, Radians heading) {
    forget(robot);
    network_.place(robot, at, heading);
}

void DrivenRobots::move(NodeId robot, Movement movement) {
    forget(robot);
    network_.move(robot, std::move(movement));
}

const DrivenRobots::Driving* DrivenRobots::driving(NodeId robot) const {
    const auto found = driving_.find(robot);
    const bool drives = found != driving_.end() && network_.now() < found->second.until;
    return drives ? &found->second : nullptr;
}

bool DrivenRobots::is_stalled(NodeId robot) const {
    const Driving* driven = driving(robot);
    return driven && driven->speed != 0 && network_.legs().leg(robot).velocity == Vec3{};
}

bool DrivenRobots::has_no_way(NodeId robot) const {
    return no_ways_->robots.contains(robot) && network_.legs().leg(robot).velocity == Vec3{};
}

Twist DrivenRobots::twist(NodeId robot) const {
    const Leg leg = network_.legs().leg(robot);
    if (network_.now() >= leg.end) return {};
    const double speed = std::sqrt(squared_distance(leg.velocity, {}));
    const Driving* driven = driving(robot);
    if (!driven) return {speed, leg.turning};
    // A chord is a little shorter than its arc.
    if (driven->arc->speed != 0) return {driven->arc->speed, leg.turning};
    return {driven->speed < 0 ? -speed : speed, leg.turning};
}

}  // namespace rovernet
