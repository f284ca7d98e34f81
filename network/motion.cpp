// SPDX-License-Identifier: MIT
#include "network/motion.hpp"

#include "network/world.hpp"

#include <algorithm>
#include <cmath>

namespace rovernet {
namespace {

void check_place(Vec3 at) {
    constexpr Range places{.low = -1e15, .high = 1e15, .text = "from -1e15 to 1e15 m"};
    for (const double x : {at.x, at.y, at.z}) {
        if (!places.contains(x)) throw_out_of_range("robot", "at", places.text, x);
    }
}

/// Removes and returns the leg that waits for the node, if there is one.
std::optional<Leg> taken(std::map<NodeId, Leg>& waiting, NodeId id) {
    if (waiting.empty()) return std::nullopt;
    const auto found = waiting.extract(id);
    return found ? std::optional(found.mapped()) : std::nullopt;
}

}  // namespace

void Motion::check(const Robot& robot) {
    if (!non_negative.contains(robot.radius.value)) {
        throw_out_of_range("robot", "radius", non_negative.text, robot.radius.value);
    }
    if (!turn_rates.contains(robot.turn_rate.value_or(RadiansPerSecond{1}).value)) {
        throw_out_of_range("robot", "turn_rate", turn_rates.text, robot.turn_rate->value);
    }
    if (!(robot.top_speed.value > 0)) {
        throw_out_of_range("robot", "top_speed", positive.text, robot.top_speed.value);
    }
    if (!any.contains(robot.heading.value)) {
        throw_out_of_range("robot", "heading", any.text, robot.heading.value);
    }
    check_place(robot.at);
}

NodeId Motion::add(Robot robot) {
    const Leg leg{
        .start = world_.now, .from = robot.at, .to = robot.at, .heading = robot.heading.value};
    const NodeId id = world_.legs.add(leg);
    channel_.added(id, leg);
    const Body body{robot.radius, robot.top_speed, robot.turn_rate};
    if (bodies_.empty() || bodies_.back() != body) bodies_.push_back(body);
    nodes_.push_back({.body = static_cast<std::uint32_t>(bodies_.size() - 1) & 0x7fffffff,
                      .movement = std::move(robot.move)});
    return id;
}

void Motion::on_leg_end(NodeId id, std::uint64_t version) {
    if (world_.legs.version(id) == version) next_leg(id);
}

Mover Motion::mover(NodeId id) {
    const Moving& robot = nodes_[id.index()];
    return {.now = world_.now,
            .position = world_.legs.position(id, world_.now),
            .radius = body(id).radius,
            .planners = *world_.planners,
            .legs = world_.legs,
            .heading = wrapped(world_.legs.leg(id).heading_at(world_.now)),
            .top_speed = body(id).top_speed,
            .draws = {.seed = world_.settings.seed,
                      .replication = world_.settings.replication,
                      .a = world_.key(id),
                      .b = robot.movements},
            .scene_now = world_.scene};
}

/// Begins movements. Their events are scheduled in the order of the robots' keys, so that the order
/// of adding robots has no effect.
void Motion::begin_all() {
    beginning_ = true;
    while (begun_ < nodes_.size()) {
        const NodeId id{static_cast<std::uint32_t>(begun_++)};
        if (world_.medium.stations().is_on(id)) {
            next_leg(id);
        } else {
            take(id, standing_leg(mover(id)));
        }
    }
    beginning_ = false;
    std::sort(set_off_.begin(), set_off_.end(),
              [this](NodeId a, NodeId b) { return world_.key(a) < world_.key(b); });
    for (const NodeId id : std::exchange(set_off_, {})) {
        world_.legs.leg(id).end == never ? tell_arrival(id) : expect_leg_end(id);
    }
}

void Motion::expect_leg_end(NodeId id) {
    if (beginning_) return set_off_.push_back(id);
    world_.events.schedule(world_.legs.leg(id).end, Priority::timer,
                           {Occurrence::Kind::leg_end, id, world_.legs.version(id)});
}

/// Schedules the callbacks for a robot that has come to rest.
void Motion::tell_arrival(NodeId id) {
    const auto reactions = on_arrival_.find(id);
    if (reactions == on_arrival_.end()) return;
    if (beginning_) return set_off_.push_back(id);
    std::erase_if(reactions->second, [](const auto& each) { return each.has_ended(); });
    for (const auto& react : reactions->second) world_.schedule(world_.now + least_reaction, react);
}

void Motion::next_leg(NodeId id) {
    if (!after_turn_.empty()) {
        if (const auto leg = taken(after_turn_, id)) return go(id, *leg);
    }
    if ((world_.doors || !held_.empty()) && is_held(id)) return;
    Mover asking = mover(id);
    const Step step = nodes_[id.index()].movement.next_leg(asking);
    const bool begins = nodes_[id.index()].moving == 0;
    nodes_[id.index()].moving = 1;
    if (const auto* leg = std::get_if<Leg>(&step)) return begin_leg(id, *leg);

    const Leg rest = standing_leg(asking);
    if (begins)
        take(id, rest);  // where it is has not been told yet
    else
        put(id, rest);
    if (const auto* blocked = std::get_if<Blocked>(&step)) {
        world_.emit(NoWay{world_.now, id, blocked->goal});
        return;
    }
    world_.emit(Arrived{world_.now, id});
    tell_arrival(id);
}

/// Begins a leg of the movement model, after turning towards it if the robot turns in place.
void Motion::begin_leg(NodeId id, const Leg& leg) {
    const auto& rate = body(id).turn_rate;
    if (!rate || leg.velocity == Vec3{}) return go(id, leg);
    if (nodes_[id.index()].movement.at_doors() == AtDoors::passes) return go(id, leg);
    const double facing = wrapped(world_.legs.leg(id).heading_at(world_.now));
    const double turn = wrapped(leg.heading - facing);
    if (turn == 0) return go(id, leg);
    const Duration turning = std::max(from_seconds(std::abs(turn) / rate->value), Duration{1});
    Leg later = leg;
    later.start += turning;
    if (later.end != never) later.end += turning;
    after_turn_[id] = later;
    take(id, {.start = world_.now,
              .end = world_.now + turning,
              .from = leg.from,
              .to = leg.from,
              .heading = facing,
              .turning = turn / seconds(turning)});
}

/// Replaces the leg, and emits Moved.
void Motion::take(NodeId id, const Leg& leg) {
    put(id, leg);
    world_.emit(Moved{world_.now, id, leg});
    if (leg.end != never) expect_leg_end(id);
}

void Motion::go(NodeId id, const Leg& leg) { world_.doors ? go_to_doors(id, leg) : take(id, leg); }

void Motion::put(NodeId id, const Leg& leg) {
    channel_.before_change(id, world_.medium.stations().is_on(id));
    channel_.goes(id, leg);
    world_.legs.replace(id, leg);
    world_.medium.moved(id, world_.legs);
    links_.look_at(id);
}

/// Removes all planned motion of the robot.
void Motion::end_movement(NodeId id) {
    Moving& robot = nodes_.at(id.index());
    ++robot.movements;
    robot.moving = false;
    interrupted_.erase(id);
    after_turn_.erase(id);
    held_.erase(id);
}

void Motion::move(NodeId id, Movement movement) {
    end_movement(id);
    nodes_[id.index()].movement = std::move(movement);
    if (world_.running && world_.medium.stations().is_on(id)) next_leg(id);
}

void Motion::place(NodeId id, Vec3 at, std::optional<Radians> heading) {
    check_place(at);
    end_movement(id);
    nodes_[id.index()].movement = Fixed{};
    nodes_[id.index()].moving = true;
    Leg leg = standing_leg(mover(id));
    leg.from = leg.to = at;
    if (heading) leg.heading = wrapped(heading->value);
    if (world_.running) return take(id, leg);
    put(id, leg);
}

void Motion::pause(NodeId id) {
    interrupted_[id] = world_.legs.leg(id);
    take(id, standing_leg(mover(id)));
}

void Motion::resume(NodeId id) {
    const Legs& legs = world_.legs;
    if (!nodes_[id.index()].moving) return next_leg(id);
    const auto leg = taken(interrupted_, id);
    if (!leg) return;
    const Duration off = world_.now - legs.leg(id).start;
    const bool unending = leg->end == never;
    const Vec3 here = legs.position(id, world_.now);
    const Leg rest{.start = world_.now,
                   .end = unending ? never : leg->end + off,
                   .from = here,
                   .velocity = leg->velocity,
                   .to = unending ? here : leg->to,
                   .heading = wrapped(legs.leg(id).heading_at(world_.now)),
                   .turning = leg->turning};
    go(id, held_.empty() || rest.velocity == Vec3{} ? rest : rest_of(id, rest));
    if (waits(id)) go_on(id);
    if (const auto later = after_turn_.find(id); later != after_turn_.end()) {
        later->second.start += off;
        if (later->second.end != never) later->second.end += off;
    }
}

}  // namespace rovernet
