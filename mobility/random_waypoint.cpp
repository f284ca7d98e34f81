// SPDX-License-Identifier: MIT
#include "mobility/random_waypoint.hpp"

#include "mobility/area.hpp"
#include "mobility/speed_range.hpp"
#include "scene/scene.hpp"

#include <stdexcept>
#include <utility>

namespace rovernet {
namespace {

void check(const RandomWaypoint& model) {
    check_fields(model, model.name);
    if (model.start != StartState::stationary || model.min_speed.value > 0) return;
    throw std::invalid_argument(
        "random_waypoint: min_speed must be > 0 for start = \"stationary\", got 0; with speeds "
        "down to 0 there is no stationary state: the mean speed decays to 0 (Yoon, Liu, Noble "
        "2003)");
}

/// Leg of the path after `metres` of it, from that point on; empty if the path is shorter, or if
/// rounding put the point too near to a wall.
std::optional<Leg> leg_after(Way& way, Mover& at, double metres, MetersPerSecond speed) {
    while (auto leg = way.next_leg(at, speed)) {
        const double length = distance(leg->from, leg->to);
        if (metres < length) {
            at.position = leg->from + (metres / length) * (leg->to - leg->from);
            if (!at.scene().passable(at.position, leg->to, at.radius)) return std::nullopt;
            return straight_leg(at, leg->to, speed);
        }
        metres -= length;
        at.position = leg->to;
    }
    return std::nullopt;
}

}  // namespace

Step RandomWaypoint::next_leg(Mover& mover, Progress& robot) const {
    if (!robot.begun) check(*this);
    const Area field(area, mover.scene(), name);
    const SpeedRange speeds(min_speed, max_speed, mover, name);
    if (!std::exchange(robot.begun, true) && mover.now == start_of_run) {
        if (start == StartState::stationary)
            return stationary_start(mover, field, speeds, pause, robot);
        if (start == StartState::uniform) {
            const auto place = field.free_place(mover, robot.draws);
            if (!place) return Blocked{field.middle()};
            Mover at = mover;
            at.position = *place;
            return new_trip(at, field, speeds, robot);
        }
    }
    if (auto leg = robot.way.next_leg(mover)) return *leg;
    if (!std::exchange(robot.rested, true) && pause > Duration{0}) {
        return straight_leg(mover, mover.position, mover.now + pause);
    }
    return new_trip(mover, field, speeds, robot);
}

Step RandomWaypoint::stationary_start(const Mover& mover, const Area& field,
                                      const SpeedRange& speeds, Duration pause, Progress& robot) {
    constexpr int most_trips = 1000;
    const double longest = field.diagonal() * (mover.scene().open_field() ? 1 : 2);
    const double rest = seconds(pause);
    const double slowness = speeds.mean_slowness();
    Draws& draws = robot.draws;
    for (int i = 0; i < most_trips; ++i) {
        const auto from = field.free_place(mover, draws);
        const auto to = field.free_place(mover, draws);
        if (!from || !to) break;
        Mover at = mover;
        at.position = *from;
        auto way = Way::plan(at, *to);
        if (!way) continue;
        const double length = way->length_left(at);
        const double cycle = rest + slowness * std::min(length, longest);
        if (draws.uniform(mover) * (rest + slowness * longest) > cycle) continue;
        if (draws.uniform(mover) * cycle < rest) {
            at.position = *to;
            return straight_leg(at, *to, at.now + from_seconds(rest * draws.uniform(mover)));
        }
        const MetersPerSecond speed{speeds.at_a_moment(draws.uniform(mover))};
        const auto leg = leg_after(*way, at, length * draws.uniform(mover), speed);
        if (!leg) continue;
        robot.rested = false;
        robot.way = std::move(*way);
        return *leg;
    }
    return Blocked{field.middle()};
}

Step RandomWaypoint::new_trip(Mover& mover, const Area& field, const SpeedRange& speeds,
                              Progress& robot) {
    constexpr int most_goals = 200;
    const MetersPerSecond speed{speeds.of_a_trip(robot.draws.uniform(mover))};
    for (int i = 0; i < most_goals; ++i) {
        const auto goal = field.free_place(mover, robot.draws);
        if (!goal) break;
        auto way = Way::plan(mover, *goal);
        if (!way) continue;
        const auto leg = way->next_leg(mover, speed);
        if (!leg) continue;
        robot.rested = false;
        robot.way = std::move(*way);
        return *leg;
    }
    return Blocked{field.middle()};
}

}  // namespace rovernet
