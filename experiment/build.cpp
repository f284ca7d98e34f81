// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"

#include "experiment/build_motion.hpp"
#include "experiment/movement_play.hpp"
#include "scenario/document/located.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace rovernet {
namespace {

/// Begins the movement of a reaction. @throws InputError at `where` if the robot cannot begin it
void begin_move(Network& network, NodeId robot, const Movement& move, Trigger trigger,
                const Location& where) {
    try {
        network.move(robot, move);
    } catch (const std::invalid_argument& error) {
        throw InputError(where, fmt::format("{} of robot \"{}\" at {:.9g} s: {}", name_of(trigger),
                                            network.name(robot),
                                            seconds(network.now() - start_of_run), error.what()));
    }
}

/// Builds the robots of one scenario into one network.
class Builder {
  public:
    /// @param roles  roles that the routing protocol knows; others are left out
    Builder(Network& network, const Scenario& scenario, std::span<const std::string_view> roles)
        : network_(network), scenario_(scenario), motion_(network, scenario), roles_(roles) {
        for (const FileRobot& robot : scenario.movement.robots) in_file_[robot.name] = &robot;
    }

    void add_robots();
    void add_reactions();
    void schedule();
    void add_traffic();

  private:
    /// A robot that is built, for what comes later.
    struct Built {
        NodeId node;
        const RobotTable* table;
        Vec3 at;
    };

    std::optional<Propagation> own_propagation(const RobotTable& table) const;
    void add_robot(const RobotTable& table, const std::string& name,
                   const std::optional<Propagation>& propagation);
    void react(const Built& robot, const ReactionTable& reaction, MotionBuilder::Plan plan);
    std::function<void(NodeId)> answer(const Built& robot, const ReactionTable& reaction,
                                       MotionBuilder::Plan plan);

    /// Action of a robot at a time given in the scenario.
    struct Due {
        std::uint64_t key;  // the robot's
        Time time;
        std::function<void()> action;
    };
    void expect(const std::string& name, Duration t, std::function<void()> action) {
        due_.push_back({name_key(name), start_of_run + t, std::move(action)});
    }

    Network& network_;
    const Scenario& scenario_;
    MotionBuilder motion_;
    std::span<const std::string_view> roles_;
    std::vector<Due> due_;
    std::map<std::string_view, const FileRobot*> in_file_;  // where the movement file has it first
    std::vector<Built> built_;
};

void Builder::add_robots() {
    std::size_t robots = scenario_.movement.robots.size();
    for (const RobotTable& table : scenario_.robots) {
        robots += static_cast<std::size_t>(table.count.value_or(1));
    }
    network_.reserve(robots);
    for (const RobotTable& table : scenario_.robots) {
        const auto own = own_propagation(table);
        for (int i = 0; i < table.count.value_or(1); ++i) add_robot(table, table.name_of(i), own);
    }
}

/// Propagation model of a robot table with its own model: one handle, so that the medium stores one
/// model for all robots of the table.
std::optional<Propagation> Builder::own_propagation(const RobotTable& table) const {
    const auto& given = table.propagation ? *table.propagation : scenario_.propagation;
    const auto& where = table.propagation ? table.propagation_where : scenario_.propagation_where;
    const Propagation model = located(where, [&] {
        auto made = given.make();
        made.check_frequency(table.radio.frequency);
        made.check_scene(network_.scene());
        return made;
    });
    return table.propagation ? std::optional(model) : std::nullopt;
}

void Builder::add_robot(const RobotTable& table, const std::string& name,
                        const std::optional<Propagation>& propagation) {
    const auto found = in_file_.find(name);
    const FileRobot* file = found == in_file_.end() ? nullptr : found->second;
    const Vec3 at = file ? file->start : motion_.start(table, name);
    const auto plan = MotionBuilder::from_the_start;
    const Movement move = file ? Fixed{} : motion_.movement(table.move, table, name, at, plan);
    const NodeId node = located(table.radio_where, [&] {
        return network_.add({.name = name,
                             .at = at,
                             .radius = table.radius,
                             .radio = table.radio,
                             .propagation = propagation,
                             .move = move,
                             .heading = table.heading,
                             .top_speed = table.top_speed.value_or(Mover::any_speed),
                             .turn_rate = table.turn_rate,
                             .role = role_under(roles_, table.role)});
    });
    built_.push_back({node, &table, at});
    for (const Duration t : table.off) {
        expect(name, t, [this_ = &network_, node] { this_->switch_off(node); });
    }
    for (const Duration t : table.on) {
        expect(name, t, [this_ = &network_, node] { this_->switch_on(node); });
    }
}

/// Schedules the actions. Actions at the same time are executed in the order of the robots' keys,
/// independent of the order in the file.
void Builder::schedule() {
    std::stable_sort(due_.begin(), due_.end(),
                     [](const Due& a, const Due& b) { return a.key < b.key; });
    for (Due& each : std::exchange(due_, {})) network_.at(each.time, std::move(each.action));
}

void Builder::add_reactions() {
    for (const Built& robot : built_) {
        MotionBuilder::Plan plan = MotionBuilder::from_the_start;
        for (const ReactionTable& reaction : robot.table->reactions) react(robot, reaction, ++plan);
    }
}

/// Action of the robot when the reaction's condition holds; its argument is the sender of the
/// message that came, if one did.
std::function<void(NodeId)> Builder::answer(const Built& robot, const ReactionTable& reaction,
                                            MotionBuilder::Plan plan) {
    std::optional<Movement> move;
    if (reaction.move) {
        move = motion_.movement(*reaction.move, *robot.table, network_.name(robot.node), robot.at,
                                plan);
    }
    std::optional<std::uint32_t> size;
    if (reaction.size) size = reaction.size->value;
    const bool to_sender = reaction.to == ReactionTable::sender;
    const bool to_robot = reaction.to && !to_sender;
    const NodeId to = to_robot ? network_.find(*reaction.to).value() : everyone;
    if (to == robot.node) {
        throw InputError(reaction.to_where, fmt::format("to: robot \"{}\" cannot send to itself; "
                                                        "expected another robot",
                                                        *reaction.to));
    }
    const Location where = reaction.move ? reaction.move->where : Location{};
    return [this_ = &network_, node = robot.node, move, where, trigger = reaction.trigger, size,
            send = reaction.send, to, to_sender, stop = reaction.stop, once = reaction.once,
            done = false](NodeId sender) mutable {
        if (once && std::exchange(done, true)) return;
        if (stop) this_->stop(node);
        if (move) begin_move(*this_, node, *move, trigger, where);
        if (!send) return;
        this_->send(node, to_sender ? sender : to, *send, {.size = size});
    };
}

void Builder::react(const Built& robot, const ReactionTable& reaction, MotionBuilder::Plan plan) {
    auto act = answer(robot, reaction, plan);
    const auto from = reaction.from ? network_.find(*reaction.from) : std::nullopt;
    switch (reaction.trigger) {
        case Trigger::on_receive:
            network_.on_receive(robot.node, [act, from, prefix = reaction.payload,
                                             hops = reaction.hops](const Heard& heard) mutable {
                const Message& message = heard.message;
                const bool wanted = message.payload.starts_with(prefix) &&
                                    (!from || message.origin == *from) &&
                                    (!hops || heard.hops <= *hops);
                if (wanted) act(message.origin);
            });
            return;
        case Trigger::on_arrival:
            network_.on_arrival(robot.node, [act]() mutable { act(everyone); });
            return;
        case Trigger::on_link_lost:
            network_.on_link_lost(robot.node, [act, from](NodeId lost) mutable {
                if (!from || lost == *from) act(everyone);
            });
            return;
        case Trigger::on_time:
            return expect(network_.name(robot.node), reaction.time,
                          [act]() mutable { act(everyone); });
    }
}

/// A source of messages, that of one [[traffic]] table.
struct Source {
    Network& network;
    TrafficTable table;
    std::uint32_t flow;
    NodeId to;
    std::vector<NodeId> from;  ///< one robot, or all that a random one is drawn from
    Key draw;                  ///< of the robot
    int sent = 0;

    NodeId sender() {
        if (from.size() == 1) return from.front();
        draw.index = static_cast<std::uint64_t>(sent);
        return from[below(draw, from.size())];
    }
};

/// Robots that may send, in an order that depends on their names only.
std::vector<NodeId> any_robot(const Network& network, NodeId but) {
    std::vector<std::pair<std::uint64_t, NodeId>> keyed;
    for (NodeId n{0}; n.index() < network.size(); ++n.value) {
        if (n != but) keyed.emplace_back(name_key(network.name(n)), n);
    }
    std::sort(keyed.begin(), keyed.end());
    std::vector<NodeId> robots;
    for (const auto& [key, node] : keyed) robots.push_back(node);
    return robots;
}

/// Sends a message, and schedules the next one.
void send_and_repeat(const std::shared_ptr<Source>& source) {
    auto& [network, table, flow, to, from, draw, sent] = *source;
    const NodeId sender = source->sender();
    const auto size = table.size ? std::optional(table.size->value) : std::nullopt;
    if (table.saturate) {
        const auto length = static_cast<std::uint32_t>(table.payload.size());
        return network.saturate(sender, to, size.value_or(length), flow, table.payload);
    }
    const Time end = table.stop ? start_of_run + *table.stop : never;
    if (network.now() >= end) return;  // "arrival" may come as late
    network.send(sender, to, table.payload,
                 {.size = size, .flow = flow, .one_hop = table.hops.has_value()});
    if (!table.every || ++sent == table.count) return;
    const Time next = network.now() + *table.every;
    if (next >= end) return;
    network.at(next, [source] { send_and_repeat(source); });
}

void Builder::add_traffic() {
    std::uint32_t flow = 0;
    for (const auto& table : scenario_.traffic) {
        const NodeId to = table.to ? network_.find(*table.to).value() : everyone;
        const auto one = network_.find(table.from);
        const auto source = std::make_shared<Source>(
            Source{network_,
                   table,
                   ++flow,
                   to,
                   one ? std::vector{*one} : any_robot(network_, to),
                   {.seed = scenario_.scenario.seed,
                    .replication = static_cast<std::uint32_t>(scenario_.scenario.replication),
                    .purpose = Purpose::traffic_source,
                    .a = name_key(table.name)}});
        if (source->from.empty()) {
            throw InputError(table.from_where,
                             "from: the only robot is the destination, so no robot is left that "
                             "could send; expected at least two robots");
        }
        if (table.start) {
            expect(table.from, *table.start, [source] { send_and_repeat(source); });
        } else {
            network_.on_arrival(*one, [source, done = false]() mutable {
                if (!std::exchange(done, true)) send_and_repeat(source);
            });
        }
    }
}

/// The robots that only the movement file names, and the file's commands for all that it names.
void play_file(Network& network, const Scenario& scenario) {
    if (!scenario.movement.file) return;
    const auto path = std::filesystem::path(scenario.file).parent_path() / *scenario.movement.file;
    std::vector<NodeId> nodes;
    MovementFile file(path.string(), scenario.movement.syntax);
    for (const FileRobot& robot : file.robots()) {
        const auto known = network.find(robot.name);
        nodes.push_back(
            known ? *known
                  : network.add({.name = robot.name, .at = robot.start, .radio = scenario.radio}));
    }
    play(network, std::move(file), std::move(nodes));
}

}  // namespace

NetworkSettings network_settings(const Scenario& scenario) {
    NetworkSettings settings{
        .seed = scenario.scenario.seed,
        .replication = static_cast<std::uint32_t>(scenario.scenario.replication),
        .propagation =
            located(scenario.propagation_where, [&] { return scenario.propagation.make(); }),
        .shadowing = scenario.shadowing,
        .fading = scenario.fading,
        .floor_height = scenario.scene.floor_height.value_or(no_storeys),
        .links = {.tolerance = scenario.links.tolerance, .min_dwell = scenario.links.min_dwell},
        .reception = scenario.reception.make(),
        .access = scenario.access.make(),
        .arp = scenario.arp,
        .propagation_delay = scenario.medium.propagation_delay,
        .event_limit = scenario.scenario.event_limit,
        .metric_parts = {.reach = scenario.metrics.reach,
                         .flows = scenario.metrics.flows,
                         .robots = scenario.metrics.robots,
                         .path_stretch = scenario.metrics.path_stretch},
    };
    std::vector<std::string> notices;  // were told when the file was loaded
    settings.scene =
        scenario.walls ? scenario.walls : load_map(scenario.scene, scenario.file, notices);
    settings.scene_changes =
        scenario.changes ? *scenario.changes : load_doors(scenario.scene, settings.scene);
    return settings;
}

void populate(Network& network, const Scenario& scenario) {
    populate(network, scenario,
             located(Location{scenario.file}, [&] { return scenario.routing.make(); }));
}

void populate(Network& network, const Scenario& scenario, Router router) {
    located(Location{scenario.file}, [&] {
        const auto roles = router.traits().roles;
        network.route(std::move(router));
        Builder builder(network, scenario, roles);
        builder.add_robots();
        builder.schedule();
        play_file(network, scenario);
        builder.add_reactions();
        builder.schedule();
        builder.add_traffic();
        builder.schedule();
    });
}

}  // namespace rovernet
