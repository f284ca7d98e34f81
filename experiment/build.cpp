// SPDX-License-Identifier: MIT
#include "experiment/build.hpp"

#include "experiment/build_motion.hpp"
#include "experiment/located.hpp"
#include "experiment/movement_play.hpp"
#include "sim/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

namespace rovernet {
namespace {

/// Builds the robots of one scenario into one network.
class Builder {
  public:
    Builder(Network& network, const Scenario& scenario)
        : network_(network), scenario_(scenario), motion_(network, scenario) {
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

    /// What a robot does at a time that the scenario tells.
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
                             .turn_rate = table.turn_rate});
    });
    built_.push_back({node, &table, at});
    for (const Duration t : table.off) {
        expect(name, t, [this_ = &network_, node] { this_->switch_off(node); });
    }
    for (const Duration t : table.on) {
        expect(name, t, [this_ = &network_, node] { this_->switch_on(node); });
    }
}

/// What is due at one time is done in the order of the robots' keys: that of the file says nothing.
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

/// What the robot does when the reaction's condition holds; its argument is the sender of the
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
    const auto to = reaction.to && !to_sender ? network_.find(*reaction.to) : std::nullopt;
    if (to == robot.node) {
        throw InputError(reaction.to_where, fmt::format("to: robot \"{}\" cannot send to itself; "
                                                        "expected another robot",
                                                        *reaction.to));
    }
    return [this_ = &network_, node = robot.node, move, size, send = reaction.send, to, to_sender,
            stop = reaction.stop, once = reaction.once, done = false](NodeId sender) mutable {
        if (once && std::exchange(done, true)) return;
        if (stop) this_->stop(node);
        if (move) this_->move(node, *move);
        if (!send) return;
        if (to || to_sender) {
            this_->unicast(node, to.value_or(sender), *send, size);
        } else {
            this_->broadcast(node, *send, size);
        }
    };
}

void Builder::react(const Built& robot, const ReactionTable& reaction, MotionBuilder::Plan plan) {
    auto act = answer(robot, reaction, plan);
    const auto from = reaction.from ? network_.find(*reaction.from) : std::nullopt;
    switch (reaction.trigger) {
        case Trigger::on_receive:
            return network_.on_receive(
                robot.node, [act, from, prefix = reaction.payload, hops = reaction.hops](
                                const Message& message, const Heard& heard) mutable {
                    const bool wanted = message.payload.starts_with(prefix) &&
                                        (!from || message.origin == *from) &&
                                        (!hops || heard.hops <= *hops);
                    if (wanted) act(message.origin);
                });
        case Trigger::on_arrival:
            return network_.on_arrival(robot.node, [act]() mutable { act(everyone); });
        case Trigger::on_link_lost:
            return network_.on_link_lost(robot.node, [act, from](NodeId lost) mutable {
                if (!from || lost == *from) act(everyone);
            });
        case Trigger::on_time:
            return expect(network_.name(robot.node), reaction.time,
                          [act]() mutable { act(everyone); });
    }
}

/// A source of messages: sends, and sees to its own next sending.
void send_and_repeat(Network& network, NodeId from, const TrafficTable& table, int sent) {
    const auto size = table.size ? std::optional(table.size->value) : std::nullopt;
    const auto to = table.to ? network.find(*table.to) : std::nullopt;
    if (table.saturate) {
        const auto length = static_cast<std::uint32_t>(table.payload.size());
        return network.saturate(from, to.value_or(everyone), size.value_or(length));
    }
    const Time end = table.stop ? start_of_run + *table.stop : never;
    if (network.now() >= end) return;  // "arrival" may come as late
    if (to) {
        network.unicast(from, *to, table.payload, size);
    } else {
        network.broadcast(from, table.payload, size);
    }
    if (!table.every || sent + 1 == table.count) return;
    const Time next = network.now() + *table.every;
    if (next >= end) return;
    network.at(next,
               [&network, from, table, sent] { send_and_repeat(network, from, table, sent + 1); });
}

void Builder::add_traffic() {
    for (const auto& table : scenario_.traffic) {
        const NodeId from = *network_.find(table.from);
        auto begin = [this_ = &network_, from, table] { send_and_repeat(*this_, from, table, 0); };
        if (table.start) {
            expect(table.from, *table.start, std::move(begin));
        } else {
            network_.on_arrival(from, [begin, done = false]() mutable {
                if (!std::exchange(done, true)) begin();
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
        .floor_height = scenario.scene.floor_height,
        .links = {.tolerance = scenario.links.tolerance, .min_dwell = scenario.links.min_dwell},
        .reception = scenario.reception.make(),
        .access = scenario.access.make(),
        .propagation_delay = scenario.medium.propagation_delay,
        .event_limit = scenario.scenario.event_limit,
    };
    std::vector<std::string> notices;  // were told when the file was loaded
    settings.scene =
        scenario.walls ? scenario.walls : load_map(scenario.scene, scenario.file, notices);
    return settings;
}

void populate(Network& network, const Scenario& scenario) {
    located(Location{scenario.file}, [&] {
        network.route(scenario.routing.flood);
        Builder builder(network, scenario);
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
