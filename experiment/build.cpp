// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"

#include "mobility/planners.hpp"
#include "mobility/waypoints.hpp"
#include "scene/occupancy.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace rovernet {
namespace {

/// Runs `make`; a caller's-fault exception in it is the input's fault at `where`.
auto located(const Location& where, auto&& make) {
    try {
        return make();
    } catch (const InputError&) {
        throw;
    } catch (const std::invalid_argument& error) {
        throw InputError(where, error.what());
    }
}

OccupancyGrid load_map(const Scenario& scenario) {
    namespace fs = std::filesystem;
    const auto& scene = scenario.scene;
    const fs::path path = fs::path(scenario.file).parent_path() / *scene.map;
    const auto extension = path.extension();
    const bool yaml = extension == ".yaml" || extension == ".yml";
    if (yaml && scene.size) {
        throw InputError(scenario.map_where,
                         "map: a map.yaml has its own size; leave out the key size");
    }
    if (!yaml && fs::is_regular_file(path) && !scene.size) {
        throw InputError(scenario.map_where,
                         fmt::format("map: \"{}\" is a picture without a scale; expected a ROS "
                                     "map.yaml, or also size = [\"40 m\", \"20 m\"]",
                                     *scene.map));
    }
    try {
        if (yaml) return read_ros_map(path.string());
        const auto size = scene.size.value_or(std::vector<Meters>{{1}, {1}});
        return image_map(path.string(), size[0], size[1]);
    } catch (const InputError& error) {
        throw InputError(scenario.map_where, std::string("map: ") + error.what());
    }
}

std::string coordinates(Vec3 p) { return fmt::format("({}, {})", p.x, p.y); }

/// Builds the robots of one scenario into one network.
class Builder {
  public:
    Builder(Network& network, const Scenario& scenario)
        : network_(network), scenario_(scenario), planners_(network.scene()) {}

    void add_robots();
    void add_traffic();

  private:
    /// What a robot does after a message is a plan of its own, with draws of its own.
    enum Plan : std::uint64_t { from_the_start, after_a_message };

    Key key(Purpose purpose, const std::string& name, std::uint64_t index,
            Plan plan = from_the_start) const {
        return {scenario_.scenario.seed,
                static_cast<std::uint32_t>(scenario_.scenario.replication),
                purpose,
                name_key(name),
                plan,
                index};
    }

    std::optional<Propagation> own_propagation(const RobotTable& table) const;
    void add_robot(const RobotTable& table, const std::string& name,
                   const std::optional<Propagation>& propagation);
    Vec3 start(const RobotTable& table, const std::string& name) const;
    Vec3 drawn_place(const RobotTable& table, const std::string& name) const;
    bool fits(Vec3 p, Meters radius) const { return network_.scene().clearance(p) >= radius.value; }
    Movement movement(const MoveTable& table, const RobotTable& robot, const std::string& name,
                      Vec3 from, Plan plan);
    Waypoints waypoints(const WaypointsTable& table, const std::string& name, Plan plan) const;
    void check_way(Vec3 from, Vec3 to, const RobotTable& robot, const Location& where);
    void react(NodeId node, const RobotTable& table, const std::string& name, Vec3 at);

    Network& network_;
    const Scenario& scenario_;
    Planners planners_;
};

void Builder::add_robots() {
    for (const auto& table : scenario_.robots) {
        const auto own = own_propagation(table);
        if (!table.count) {
            add_robot(table, table.name, own);
            continue;
        }
        for (int i = 0; i < *table.count; ++i) {
            add_robot(table, fmt::format("{}{}", table.name, i), own);
        }
    }
}

/// The model of a robot table that has its own: one handle, so that the medium keeps one model for
/// all robots of the table.
std::optional<Propagation> Builder::own_propagation(const RobotTable& table) const {
    const auto& given = table.propagation ? *table.propagation : scenario_.propagation;
    const auto& where = table.propagation ? table.propagation_where : scenario_.propagation_where;
    const Propagation model = located(where, [&] {
        auto made = given.make();
        made.check_frequency(table.radio.frequency);
        return made;
    });
    return table.propagation ? std::optional(model) : std::nullopt;
}

void Builder::add_robot(const RobotTable& table, const std::string& name,
                        const std::optional<Propagation>& propagation) {
    const Vec3 at = start(table, name);
    const NodeId node = located(table.radio_where, [&] {
        return network_.add({.name = name,
                             .at = at,
                             .radius = table.radius,
                             .radio = table.radio,
                             .propagation = propagation,
                             .move = movement(table.move, table, name, at, from_the_start)});
    });
    for (const Duration t : table.off) {
        network_.at(start_of_run + t, [this_ = &network_, node] { this_->switch_off(node); });
    }
    for (const Duration t : table.on) {
        network_.at(start_of_run + t, [this_ = &network_, node] { this_->switch_on(node); });
    }
    if (table.on_receive) react(node, table, name, at);
}

Vec3 Builder::start(const RobotTable& table, const std::string& name) const {
    const Vec3 at = table.at ? *table.at : drawn_place(table, name);
    if (!fits(at, table.radius)) {
        throw InputError(
            table.at ? table.at_where : table.place->where,
            fmt::format("robot \"{}\" at {} m is inside a wall or nearer to one than its radius "
                        "of {} m (clearance {:.3f} m); move it or give it a smaller radius",
                        name, coordinates(at), table.radius.value, network_.scene().clearance(at)));
    }
    return at;
}

Vec3 Builder::drawn_place(const RobotTable& table, const std::string& name) const {
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

Movement Builder::movement(const MoveTable& table, const RobotTable& robot, const std::string& name,
                           Vec3 from, Plan plan) {
    if (const auto* path = std::get_if<WaypointsTable>(&table.model)) {
        const Waypoints model = waypoints(*path, name, plan);
        Vec3 at = from;
        for (const Vec3 place : path->path) {
            check_way(std::exchange(at, place), place, robot, table.where);
        }
        return model;
    }
    if (const auto* goal = std::get_if<GoalTable>(&table.model)) {
        const auto choices = goal->among.size();
        const Vec3 to = goal->to
                            ? *goal->to
                            : goal->among[below(key(Purpose::destination, name, 0, plan), choices)];
        check_way(from, to, robot, table.where);
        return ToGoal{.to = to, .speed = goal->speed};
    }
    return Fixed{};
}

Waypoints Builder::waypoints(const WaypointsTable& table, const std::string& name,
                             Plan plan) const {
    Waypoints model{.speed = table.speed};
    auto path = table.path;
    if (table.order == WaypointsTable::Order::shuffled) {
        for (std::size_t i = path.size(); i > 1; --i) {
            std::swap(path[i - 1], path[below(key(Purpose::order, name, i, plan), i)]);
        }
    }
    if (!table.times) {
        model.path = std::move(path);
        return model;
    }
    for (std::size_t i = 0; i < path.size(); ++i)
        model.timed.push_back({(*table.times)[i], path[i]});
    return model;
}

void Builder::check_way(Vec3 from, Vec3 to, const RobotTable& robot, const Location& where) {
    if (network_.scene().open_field()) return;
    if (planners_.of_radius(robot.radius).shortest_path(from, to)) return;
    const bool fits_there = network_.scene().inside_map(to) && fits(to, robot.radius);
    throw InputError(where, fmt::format("move: no way from {} m to {} m for a robot of radius {} "
                                        "m: {}; expected a place that can be reached",
                                        coordinates(from), coordinates(to), robot.radius.value,
                                        fits_there ? "walls are all around"
                                                   : "it is in a wall, too near to one, or off "
                                                     "the map"));
}

void Builder::react(NodeId node, const RobotTable& table, const std::string& name, Vec3 at) {
    const OnReceiveTable& reaction = *table.on_receive;
    network_.on_receive(
        node, [this_ = &network_, node, prefix = reaction.payload, once = reaction.once,
               done = false, move = movement(*reaction.move, table, name, at, after_a_message)](
                  const Message& message) mutable {
            if (!message.payload.starts_with(prefix) || (once && done)) return;
            done = true;
            this_->move(node, move);
        });
}

/// A source of messages: sends, and sees to its own next sending.
void send_and_repeat(Network& network, NodeId from, const TrafficTable& table, int sent) {
    network.broadcast(from, table.payload,
                      table.size ? std::optional(table.size->value) : std::nullopt);
    if (!table.every || sent + 1 == table.count) return;
    const Time next = network.now() + *table.every;
    if (table.stop && next >= start_of_run + *table.stop) return;
    network.at(next,
               [&network, from, table, sent] { send_and_repeat(network, from, table, sent + 1); });
}

void Builder::add_traffic() {
    for (const auto& table : scenario_.traffic) {
        const NodeId from = *network_.find(table.from);
        auto begin = [this_ = &network_, from, table] { send_and_repeat(*this_, from, table, 0); };
        if (table.start) {
            network_.at(start_of_run + *table.start, std::move(begin));
        } else {
            network_.on_arrival(from, [begin, done = false]() mutable {
                if (!std::exchange(done, true)) begin();
            });
        }
    }
}

}  // namespace

NetworkSettings network_settings(const Scenario& scenario) {
    NetworkSettings settings{
        .seed = scenario.scenario.seed,
        .replication = static_cast<std::uint32_t>(scenario.scenario.replication),
        .propagation =
            located(scenario.propagation_where, [&] { return scenario.propagation.make(); }),
        .floor_height = scenario.scene.floor_height,
        .propagation_delay = scenario.medium.propagation_delay,
        .event_limit = scenario.scenario.event_limit,
    };
    if (scenario.scene.map) {
        settings.scene = located(scenario.map_where,
                                 [&] { return std::make_shared<const Scene>(load_map(scenario)); });
    }
    return settings;
}

void populate(Network& network, const Scenario& scenario) {
    network.route(scenario.routing.flood);
    Builder builder(network, scenario);
    builder.add_robots();
    builder.add_traffic();
}

}  // namespace rovernet
