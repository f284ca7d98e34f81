// SPDX-License-Identifier: MIT
#include "experiment/build_motion.hpp"

#include "experiment/unknown_cells.hpp"
#include "mobility/planners.hpp"
#include "mobility/waypoints.hpp"
#include "scenario/document/located.hpp"
#include "sim/random.hpp"
#include "sim/told_apart.hpp"

#include <fmt/format.h>

#include <utility>

namespace rovernet {
namespace {

std::string coordinates(Vec3 p) {
    return p.z == 0 ? fmt::format("({}, {})", p.x, p.y)
                    : fmt::format("({}, {}, {})", p.x, p.y, p.z);
}

}  // namespace

MotionBuilder::MotionBuilder(Network& network, const Scenario& scenario)
    : network_(network), scenario_(scenario) {
    std::uint32_t next = 0;
    for (const RobotTable& table : scenario.robots) {
        for (int i = 0; i < table.count.value_or(1); ++i) {
            ids_.emplace(table.name_of(i), NodeId{next++});
        }
    }
    for (const FileRobot& robot : scenario.movement.robots) {
        if (ids_.emplace(robot.name, NodeId{next}).second) ++next;
    }
}

Key MotionBuilder::key(Purpose purpose, const std::string& name, std::uint64_t index,
                       Plan plan) const {
    return {scenario_.scenario.seed,
            static_cast<std::uint32_t>(scenario_.scenario.replication),
            purpose,
            name_key(name),
            plan,
            index};
}

bool MotionBuilder::fits(Vec3 p, Meters radius) const {
    return network_.scene().clearance(p) >= radius.value;
}

Vec3 MotionBuilder::start(const RobotTable& table, const std::string& name) {
    const Vec3 at = table.at      ? *table.at
                    : table.place ? drawn_place(table, name)
                                  : place_of_model(table, name);
    if (scenario_.scene.world || fits(at, table.radius)) return at;  // as in Stage
    const Location& where = table.place ? table.place->where : table.at_where;
    const std::string unknown = unknown_cell_text(network_.scene(), at, table.radius, "its radius");
    if (!unknown.empty())
        throw InputError(where,
                         fmt::format("robot \"{}\" at {} m {}", name, coordinates(at), unknown));
    throw InputError(
        where,
        fmt::format("robot \"{}\" at {} m is inside a wall, or nearer to a wall than its radius of "
                    "{} m (clearance {} m); move the robot or give it a smaller radius",
                    name, coordinates(at), table.radius.value,
                    told_apart(network_.scene().clearance(at), table.radius.value, 3)));
}

Vec3 MotionBuilder::drawn_place(const RobotTable& table, const std::string& name) const {
    const PlaceTable& place = *table.place;
    if (place.model == PlaceTable::Model::choice) {
        return place.points[below(key(Purpose::placement, name, 0), place.points.size())];
    }
    constexpr std::uint64_t most_tries = 10'000;
    const Vec3 low = place.area[0], high = place.area[1];
    Vec3 p;
    for (std::uint64_t i = 0; i < most_tries; ++i) {
        p = {low.x + uniform(key(Purpose::placement, name, 2 * i)) * (high.x - low.x),
             low.y + uniform(key(Purpose::placement, name, 2 * i + 1)) * (high.y - low.y), low.z};
        if (fits(p, table.radius)) return p;
    }
    throw InputError(place.where, fmt::format("area: no room for robot \"{}\" after {} tries; "
                                              "expected an area with space free of walls",
                                              name, most_tries));
}

/// The movement model says where the robot is first.
Vec3 MotionBuilder::place_of_model(const RobotTable& table, const std::string& name) {
    const Movement model = std::visit(
        [](const auto& m) -> Movement {
            if constexpr (MovementModel<std::decay_t<decltype(m)>>) return m;
            return Fixed{};
        },
        table.move.model);
    const Step step = located(table.move.where, [&] { return first_step(model, table, name, {}); });
    if (const auto* leg = std::get_if<Leg>(&step)) return leg->from;
    throw InputError(table.move.where,
                     fmt::format("move: no room for robot \"{}\" of radius {} m; expected an area "
                                 "with space free of walls",
                                 name, table.radius.value));
}

/// First step of the model, without consequences.
Step MotionBuilder::first_step(Movement movement, const RobotTable& robot, const std::string& name,
                               Vec3 from) {
    Mover mover{.now = start_of_run,
                .position = from,
                .radius = robot.radius,
                .planners = network_.planners(),
                .legs = network_.legs(),
                .heading = robot.heading.value,
                .top_speed = robot.top_speed.value_or(Mover::any_speed),
                .draws = key(Purpose::movement, name, 0),
                .scene_now = &network_.scene()};
    return movement.next_leg(mover);
}

Movement MotionBuilder::movement(const MoveTable& move, const RobotTable& robot,
                                 const std::string& name, Vec3 from, Plan plan) {
    return std::visit([&](const auto& model) { return make(model, move, robot, name, from, plan); },
                      move.model);
}

Movement MotionBuilder::make(const WaypointsTable& table, const MoveTable& move,
                             const RobotTable& robot, const std::string& name, Vec3 from,
                             Plan plan) {
    for (Vec3 at = from; const Vec3 place : table.path) {
        check_way(std::exchange(at, place), place, robot, move.where);
    }
    auto path = table.path;
    if (table.order == WaypointsTable::Order::shuffled) {
        for (std::size_t i = path.size(); i > 1; --i) {
            std::swap(path[i - 1], path[below(key(Purpose::order, name, i, plan), i)]);
        }
    }
    Waypoints model{.speed = table.speed};
    if (!table.times) {
        model.path = std::move(path);
        return model;
    }
    for (std::size_t i = 0; i < path.size(); ++i)
        model.timed.push_back({(*table.times)[i], path[i]});
    return model;
}

Movement MotionBuilder::make(const GoalTable& goal, const MoveTable& move, const RobotTable& robot,
                             const std::string& name, Vec3 from, Plan plan) {
    const auto choices = goal.among.size();
    const Vec3 to =
        goal.to ? *goal.to : goal.among[below(key(Purpose::destination, name, 0, plan), choices)];
    check_way(from, to, robot, move.where);
    return ToGoal{.to = to, .speed = goal.speed};
}

template <class Model>
Movement MotionBuilder::make(Model model, const MoveTable& move, const RobotTable& robot,
                             const std::string& name, Vec3 from, Plan plan) {
    if constexpr (LedModel<Model>) {
        model.leader = ids_.find(move.leader)->second;
        if (robot.count || ids_.find(name)->second != model.leader) return model;
        throw InputError(move.leader_where,
                         fmt::format("leader: robot \"{}\" cannot follow itself; "
                                     "expected another robot",
                                     name));
    } else {
        if constexpr (std::same_as<Model, Patrol>) {
            for (Vec3 at = from; const Vec3 place : model.path) {
                check_way(std::exchange(at, place), place, robot, move.where);
            }
        }
        located(move.where, [&] {
            Model tried = model;
            // The place where a reaction begins is not known, so that a model that begins in its
            // area is tried at a place that the model draws.
            if constexpr (DrawnModel<Model>) {
                if (plan != from_the_start) tried.start = decltype(tried.start)::uniform;
            }
            return first_step(std::move(tried), robot, name, from);
        });
        if constexpr (SharedMovementModel<Model>) {
            const auto [known, is_new] = shared_.try_emplace(&move);
            if (is_new) known->second = std::move(model);
            return known->second;
        }
        return model;
    }
}

void MotionBuilder::check_way(Vec3 from, Vec3 to, const RobotTable& robot, const Location& where) {
    if (network_.scene().open_field()) return;
    Planners& planners = network_.planners();
    if (planners.has_way(from, to, robot.radius)) return;
    const bool fits_there = network_.scene().inside_map(to) && fits(to, robot.radius);
    if (fits_there && !planners.is_level(from, to)) {
        throw InputError(
            where,
            fmt::format("move: no stairs from {} m to {} m for a robot of radius {} m: a wall "
                        "blocks the straight path between the two storeys; expected a place at the "
                        "foot of the stairs from which this straight path is free of walls",
                        coordinates(from), coordinates(to), robot.radius.value));
    }
    const std::string unknown =
        unknown_cell_text(network_.scene(), to, robot.radius, "the robot's radius");
    const std::string why = fits_there         ? "walls separate the two places"
                            : !unknown.empty() ? "the destination " + unknown
                            : network_.scene().has_border()
                                ? "the destination is in a wall, too near to a wall, or off the map"
                                : "the destination is in a wall, or too near to a wall";
    throw InputError(where,
                     fmt::format("move: no path from {} m to {} m for a robot of radius {} "
                                 "m: {}; expected a place that can be reached",
                                 coordinates(from), coordinates(to), robot.radius.value, why));
}

}  // namespace rovernet
