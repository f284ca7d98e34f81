// SPDX-License-Identifier: MIT
#include "network/engine.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

void check_place(Vec3 at) {
    constexpr Range places{.low = -1e15, .high = 1e15, .text = "from -1e15 to 1e15 m"};
    for (const double x : {at.x, at.y, at.z}) {
        if (!places.contains(x)) throw_out_of_range("robot", "at", places.text, x);
    }
}

/// The leg that waits for the node, if one does; it waits no more.
std::optional<Leg> taken(std::map<NodeId, Leg>& waiting, NodeId id) {
    if (waiting.empty()) return std::nullopt;
    const auto found = waiting.extract(id);
    return found ? std::optional(found.mapped()) : std::nullopt;
}

}  // namespace

void Engine::reserve(std::size_t robots) {
    legs_.reserve(robots);
    medium_.reserve(robots);
    names_.reserve(robots);
}

NodeId Engine::add(Robot robot) {
    if (robot.name.empty()) robot.name = fmt::format("r{}", nodes_.size());
    if (names_.find(robot.name)) {
        throw std::invalid_argument(fmt::format("two robots are named \"{}\"", robot.name));
    }
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
    if (std::holds_alternative<Sinr>(settings_.reception)) check_rate(robot.radio.rate);
    const auto key = name_key(robot.name);
    medium_.add(robot.radio, key, robot.propagation.value_or(settings_.propagation));
    if (aloha_) aloha_->add();
    if (dcf_) dcf_->add();
    const Leg leg{.start = now_, .from = robot.at, .to = robot.at, .heading = robot.heading.value};
    const NodeId id = legs_.add(leg);
    if (frames_meet_) {
        keep_past(id, false);
        on_air_.goes(leg, robot.radio.antenna_height);
    }
    names_.add(robot.name);
    const Body body{robot.radius, robot.top_speed, robot.turn_rate};
    if (bodies_.empty() || bodies_.back() != body) bodies_.push_back(body);
    nodes_.push_back({.body = static_cast<std::uint32_t>(bodies_.size() - 1),
                      .movement = std::move(robot.move)});
    if (watch_) watch_->added(id, now_);
    if (running_) begin_movements();
    return id;
}

Mover Engine::mover(NodeId id) {
    const Node& robot = node(id);
    return {.now = now_,
            .position = legs_.position(id, now_),
            .radius = body(id).radius,
            .planners = *planners_,
            .legs = legs_,
            .heading = wrapped(legs_.leg(id).heading_at(now_)),
            .top_speed = body(id).top_speed,
            .draws = {.seed = settings_.seed,
                      .replication = settings_.replication,
                      .a = key(id),
                      .b = robot.movements}};
}

/// Movements that begin at one time are scheduled in the order of the robots' keys: the order in
/// which robots were added decides nothing.
void Engine::begin_movements() {
    beginning_ = true;
    while (begun_ < nodes_.size()) {
        const NodeId id{static_cast<std::uint32_t>(begun_++)};
        if (medium_.is_on(id)) {
            next_leg(id);
        } else {
            take(id, standing_leg(mover(id)));
        }
    }
    beginning_ = false;
    std::sort(set_off_.begin(), set_off_.end(),
              [this](NodeId a, NodeId b) { return key(a) < key(b); });
    for (const NodeId id : std::exchange(set_off_, {})) {
        legs_.leg(id).end == never ? tell_arrival(id) : expect_leg_end(id);
    }
}

void Engine::expect_leg_end(NodeId id) {
    if (beginning_) return set_off_.push_back(id);
    queue_.schedule(legs_.leg(id).end, Priority::timer,
                    {Occurrence::Kind::leg_end, id, legs_.version(id)});
}

/// Calls back who waits for the robot to come to rest.
void Engine::tell_arrival(NodeId id) {
    const auto reactions = on_arrival_.find(id);
    if (reactions == on_arrival_.end()) return;
    if (beginning_) return set_off_.push_back(id);
    for (const auto& react : reactions->second) schedule(now_ + least_reaction, {react});
}

void Engine::next_leg(NodeId id) {
    if (const auto leg = taken(after_turn_, id)) return take(id, *leg);
    Mover asking = mover(id);
    const Step step = node(id).movement.next_leg(asking);
    const bool begins = !std::exchange(node(id).moving, true);
    if (const auto* leg = std::get_if<Leg>(&step)) return begin_leg(id, *leg);

    const Leg rest = standing_leg(asking);
    if (begins)
        take(id, rest);  // where it is has not been told yet
    else
        put(id, rest);
    if (const auto* blocked = std::get_if<Blocked>(&step)) {
        emit(NoWay{now_, id, blocked->goal});
        return;
    }
    emit(Arrived{now_, id});
    tell_arrival(id);
}

/// Takes a leg of the movement model, after turning towards it if the robot turns in place.
void Engine::begin_leg(NodeId id, const Leg& leg) {
    const auto& rate = body(id).turn_rate;
    if (!rate || leg.velocity == Vec3{}) return take(id, leg);
    const double facing = wrapped(legs_.leg(id).heading_at(now_));
    const double turn = wrapped(leg.heading - facing);
    if (turn == 0) return take(id, leg);
    const Duration turning = std::max(from_seconds(std::abs(turn) / rate->value), Duration{1});
    Leg later = leg;
    later.start += turning;
    if (later.end != never) later.end += turning;
    after_turn_[id] = later;
    take(id, {.start = now_,
              .end = now_ + turning,
              .from = leg.from,
              .to = leg.from,
              .heading = facing,
              .turning = turn / seconds(turning)});
}

/// Replaces the leg, and tells of it.
void Engine::take(NodeId id, const Leg& leg) {
    put(id, leg);
    emit(Moved{now_, id, leg});
    if (leg.end != never) expect_leg_end(id);
}

void Engine::put(NodeId id, const Leg& leg) {
    if (frames_meet_) {
        keep_past(id, medium_.is_on(id));
        on_air_.goes(leg, medium_.radio(id).antenna_height);
    }
    legs_.replace(id, leg);
    medium_.moved(id, legs_);
    if (!watch_) return;
    watch_->leg_changed(id, now_);
    expect_link_change();
}

/// What the robot was about to do is void.
void Engine::end_movement(NodeId id) {
    Node& robot = node(id);
    ++robot.movements;
    robot.moving = false;
    interrupted_.erase(id);
    after_turn_.erase(id);
}

void Engine::move(NodeId id, Movement movement) {
    end_movement(id);
    node(id).movement = std::move(movement);
    if (running_ && medium_.is_on(id)) next_leg(id);
}

void Engine::place(NodeId id, Vec3 at) {
    check_place(at);
    end_movement(id);
    node(id).movement = Fixed{};
    node(id).moving = true;
    Leg leg = standing_leg(mover(id));
    leg.from = leg.to = at;
    if (running_) return take(id, leg);
    put(id, leg);
}

void Engine::switch_robot(NodeId id, bool on) {
    if (medium_.is_on(id) == on) return;
    if (frames_meet_) keep_past(id, !on);
    medium_.switch_radio(id, on);
    if (!on && aloha_) aloha_->switch_off(*this, id);
    if (!on && dcf_) dcf_->switch_off(*this, id);
    emit(Switched{now_, id, on});
    if (watch_) {
        watch_->switched(id, now_);
        expect_link_change();
    }
    if (!running_) return;
    if (!on) {
        interrupted_[id] = legs_.leg(id);
        take(id, standing_leg(mover(id)));
    } else if (!node(id).moving) {
        next_leg(id);
    } else if (const auto leg = taken(interrupted_, id)) {
        const Duration off = now_ - legs_.leg(id).start;
        const bool unending = leg->end == never;
        take(id, {.start = now_,
                  .end = unending ? never : leg->end + off,
                  .from = legs_.position(id, now_),
                  .velocity = leg->velocity,
                  .to = unending ? legs_.position(id, now_) : leg->to,
                  .heading = wrapped(legs_.leg(id).heading_at(now_)),
                  .turning = leg->turning});
        if (const auto later = after_turn_.find(id); later != after_turn_.end()) {
            later->second.start += off;
            if (later->second.end != never) later->second.end += off;
        }
    }
}

}  // namespace rovernet
