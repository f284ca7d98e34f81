// SPDX-License-Identifier: MIT
#include "experiment/engine.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace rovernet {

NodeId Engine::add(Robot robot) {
    if (robot.name.empty()) robot.name = fmt::format("r{}", nodes_.size());
    if (by_name_.contains(robot.name)) {
        throw std::invalid_argument(fmt::format("two robots are named \"{}\"", robot.name));
    }
    if (!non_negative.contains(robot.radius.value)) {
        throw_out_of_range("robot", "radius", non_negative.text, robot.radius.value);
    }
    for (const double x : {robot.at.x, robot.at.y, robot.at.z}) {
        if (!any.contains(x)) throw_out_of_range("robot", "at", "finite", x);
    }
    const auto key = name_key(robot.name);
    medium_.add(robot.radio, key, robot.propagation.value_or(settings_.propagation));
    const NodeId id =
        legs_.add({.start = now_, .from = robot.at, .to = robot.at, .heading = robot.heading});
    by_name_[robot.name] = id;
    nodes_.push_back({.name = std::move(robot.name),
                      .key = key,
                      .radius = robot.radius,
                      .movement = std::move(robot.move),
                      .top_speed = robot.top_speed,
                      .turn_rate = robot.turn_rate});
    if (running_) begin_movements();
    return id;
}

Mover Engine::mover(NodeId id) {
    const Node& robot = node(id);
    return {.now = now_,
            .position = legs_.position(id, now_),
            .radius = robot.radius,
            .planners = planners_,
            .legs = legs_,
            .heading = legs_.leg(id).heading_at(now_),
            .top_speed = robot.top_speed,
            .draws = {.seed = settings_.seed,
                      .replication = settings_.replication,
                      .a = robot.key,
                      .b = robot.movements}};
}

void Engine::begin_movements() {
    while (begun_ < nodes_.size()) {
        const NodeId id{static_cast<std::uint32_t>(begun_++)};
        if (medium_.is_on(id)) {
            next_leg(id);
        } else {
            take(id, standing_leg(mover(id)));
        }
    }
}

void Engine::next_leg(NodeId id) {
    Mover asking = mover(id);
    const Step step = node(id).movement.next_leg(asking);
    const bool begins = !std::exchange(node(id).moving, true);
    if (const auto* leg = std::get_if<Leg>(&step)) return take(id, *leg);

    const Leg rest = standing_leg(asking);
    if (begins)
        take(id, rest);  // where it is has not been told yet
    else
        legs_.replace(id, rest);
    if (const auto* blocked = std::get_if<Blocked>(&step)) {
        emit(NoWay{now_, id, blocked->goal});
        return;
    }
    emit(Arrived{now_, id});
    for (std::size_t i = 0; i < node(id).on_arrival.size(); ++i) {
        schedule(now_ + least_reaction, {node(id).on_arrival[i]});
    }
}

void Engine::take(NodeId id, const Leg& leg) {
    legs_.replace(id, leg);
    emit(Moved{now_, id, leg});
    if (leg.end == never) return;
    queue_.schedule(leg.end, Priority::timer, {Occurrence::Kind::leg_end, id, legs_.version(id)});
}

void Engine::move(NodeId id, Movement movement) {
    node(id).movement = std::move(movement);
    node(id).moving = false;
    node(id).interrupted.reset();
    if (running_ && medium_.is_on(id)) next_leg(id);
}

void Engine::switch_robot(NodeId id, bool on) {
    if (medium_.is_on(id) == on) return;
    medium_.switch_radio(id, on);
    emit(Switched{now_, id, on});
    if (!running_) return;
    Node& robot = node(id);
    if (!on) {
        robot.interrupted = legs_.leg(id);
        take(id, standing_leg(mover(id)));
    } else if (!robot.moving) {
        next_leg(id);
    } else if (const auto leg = std::exchange(robot.interrupted, std::nullopt)) {
        const Duration off = now_ - legs_.leg(id).start;
        const bool unending = leg->end == never;
        take(id, {.start = now_,
                  .end = unending ? never : leg->end + off,
                  .from = legs_.position(id, now_),
                  .velocity = leg->velocity,
                  .to = unending ? legs_.position(id, now_) : leg->to});
    }
}

}  // namespace rovernet
