// SPDX-License-Identifier: MIT
#include "experiment/reports/link_report.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/reports/range_of_model.hpp"
#include "models/link_gain.hpp"
#include "models/medium/medium.hpp"
#include "models/medium/shadowed.hpp"
#include "models/propagation/floors_between.hpp"
#include "models/propagation/itu_indoor.hpp"
#include "models/propagation/multi_wall.hpp"
#include "models/propagation/rays.hpp"
#include "scenario/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace rovernet {

namespace {

/// These robots and, transitively, the leaders that they follow.
std::set<std::string> with_leaders(const Scenario& scenario, std::set<std::string> robots) {
    std::map<std::string, std::string> leaders;
    for (const RobotTable& table : scenario.robots) {
        if (table.move.leader.empty()) continue;
        for (int i = 0; i < table.count.value_or(1); ++i) {
            leaders.emplace(table.name_of(i), table.move.leader);
        }
    }
    for (std::vector<std::string> left(robots.begin(), robots.end()); !left.empty();) {
        const auto leader = leaders.find(left.back());
        left.pop_back();
        if (leader == leaders.end() || !robots.insert(leader->second).second) continue;
        left.push_back(leader->second);
    }
    return robots;
}

/// A movement depends only on the robot's random draws and on its leaders. Other robots need not
/// move, unless a robot reacts to events.
void keep_others_still(Network& network, const Scenario& scenario,
                       const std::set<std::string>& asked_for) {
    if (somebody_reacts(scenario)) return;
    const auto needed = with_leaders(scenario, asked_for);
    for (NodeId node{0}; node.index() < network.size(); ++node.value) {
        if (!needed.contains(network.name(node))) network.move(node, Fixed{});
    }
}

/// Loss [dB] of a link by another model or in another scene than its own.
double loss_by(const Propagation& model, const Scene& scene, const Network& network, NodeId from,
               NodeId to, Vec3 here, Vec3 there, std::optional<Meters> floor_height = {}) {
    const Stations& stations = network.medium().stations();
    const LinkBatch link{.frequency = stations.radio(from).frequency,
                         .from = here,
                         .from_key = stations.key(from),
                         .scene = &scene,
                         .floor_height = floor_height.value_or(network.settings().floor_height),
                         .seed = network.settings().seed,
                         .replication = network.settings().replication};
    return model.loss_to(there, link, stations.key(to));
}

/// The model of what a robot sends, without shadowing.
const Propagation& base_model(const Network& network, NodeId from) {
    const Propagation& used = network.medium().stations().model(from);
    const Shadowed* shadowed = used.as<Shadowed>();
    return shadowed ? shadowed->base() : used;
}

/// Loss of each wall of a link [dB]. A material with a given loss has that loss; the propagation
/// model's loss for the other walls is divided in proportion to their lengths.
std::vector<Db> wall_losses(const Network& network, NodeId from, NodeId to, const LinkReport& link,
                            Vec3 here, Vec3 there) {
    const double without_walls =
        loss_by(network.medium().stations().model(from), network.scene().with_walls_of(Scene()),
                network, from, to, here, there);

    const auto& materials = network.scene().materials();
    const MultiWall* counts = base_model(network, from).as<MultiWall>();
    std::vector<Db> losses;
    double left = link.path_loss.value - without_walls, plain_m = 0;
    for (const Wall& wall : link.walls) {
        const Material& material = materials[wall.material];
        const WallRate rate = wall_rate(material, link.sender.frequency, 0);
        losses.push_back(counts ? counts->wall_loss(wall, material, link.sender.frequency)
                                : Db{rate.per_crossing + rate.per_metre * wall.length});
        left -= losses.back().value;
        if (material.follows_model()) plain_m += wall.length;
    }
    for (std::size_t i = 0; i < losses.size() && !counts; ++i) {
        const Wall& wall = link.walls[i];
        if (materials[wall.material].follows_model())
            losses[i].value = left * wall.length / plain_m;
    }
    return losses;
}

/// Ceilings and floors between the antennas of a link, and what they take.
struct Floors {
    std::size_t ceilings = 0, number = 0;
    Db ceiling_loss{0}, floor_loss{0};
};

Floors floors_between(const Network& network, NodeId from, NodeId to, Vec3 here, Vec3 there) {
    const Scene& scene = network.scene();
    const Propagation& model = base_model(network, from);
    const ItuIndoor* itu = model.as<ItuIndoor>();
    Floors out{.ceilings = scene.storeys().ceilings_between(here.z, there.z).size()};
    const LinkBatch batch{.frequency = network.medium().stations().radio(from).frequency,
                          .from = here,
                          .to = {&there, 1},
                          .scene = &scene,
                          .floor_height = network.settings().floor_height};
    const FloorsBetween counted = FloorCounter(batch).between(0);
    out.number = static_cast<std::size_t>(itu && itu->floors ? *itu->floors : counted.of_model);
    if (out.number == 0 && out.ceilings == 0) return out;
    Propagation without = model;
    if (itu) {
        ItuIndoor level = *itu;
        level.floors = 0;
        without = level;
    }
    const Db all{loss_by(model, scene.with_walls_of(Scene()), network, from, to, here, there) -
                 loss_by(without, Scene(), network, from, to, here, there, no_storeys)};
    if (out.ceilings > 0) out.ceiling_loss = all;
    // Ceilings with a loss of their own are no floors of the model.
    if (out.number > 0) out.floor_loss = all - Db{counted.loss_db};
    return out;
}

std::string why_down(const Network& network, NodeId from, NodeId to, const LinkReport& link) {
    const Medium& medium = network.medium();
    for (const NodeId node : {from, to}) {
        if (!medium.stations().is_on(node)) return network.name(node) + " is off";
    }
    if (!medium.stations().may_link(from, to)) {
        const Radio &a = link.sender, &b = link.receiver;
        const std::string gate = "the robots are in different networks: ";
        if (a.frequency != b.frequency) {
            return gate + fmt::format("frequency {:g} MHz and {:g} MHz", a.frequency.value / 1e6,
                                      b.frequency.value / 1e6);
        }
        if (a.channel != b.channel) {
            return gate + fmt::format("channel {} and {}", a.channel, b.channel);
        }
        return gate + fmt::format("essid \"{}\" and \"{}\"", a.essid, b.essid);
    }
    if (link.range && link.distance_m > link.range->value) {
        return fmt::format("{:.6g} m, beyond the sender's range of {:.6g} m", link.distance_m,
                           link.range->value);
    }
    return "the received power is below the receiver's sensitivity";
}

/// Parts of a link's path loss: shadowing, walls, rays.
void add_parts(LinkReport& report, const Network& network, NodeId from, NodeId to, Vec3 here,
               Vec3 there) {
    const Propagation& used = network.medium().stations().model(from);
    const Shadowed* shadowed = used.as<Shadowed>();
    const Propagation& model = shadowed ? shadowed->base() : used;
    report.model = std::string(model.name());
    if (shadowed) {
        report.shadowing =
            report.path_loss - Db{loss_by(model, network.scene(), network, from, to, here, there)};
    }
    if (const Rays* rays = model.as<Rays>()) {
        report.rays = rays->paths({.frequency = report.sender.frequency,
                                   .from = here,
                                   .to = {&there, 1},
                                   .scene = &network.scene()});
    }
    if (model.shape() == LossShape::by_walls) {
        report.wall_losses = wall_losses(network, from, to, report, here, there);
    }
    const Scene& scene = network.scene();
    report.ignores_walls =
        !report.walls.empty() && !report.rays && report.wall_losses.empty() &&
        loss_by(model, scene, network, from, to, here, there) ==
            loss_by(model, scene.with_walls_of(Scene()), network, from, to, here, there);
    for (const Wall& wall : report.walls) {
        report.materials.push_back(network.scene().materials()[wall.material].name);
    }
}

/// The link as it is at a time.
LinkReport report_at(const Network& network, NodeId from, NodeId to, Time at) {
    const Legs& legs = network.legs();
    const Stations& stations = network.medium().stations();
    const LinkLosses& links = network.medium().links();
    const Pose here = stations.pose(from, at, legs), there = stations.pose(to, at, legs);
    const Vec3 a = here.antenna, b = there.antenna;
    const Floors floors = floors_between(network, from, to, a, b);
    LinkReport report{.from = std::string(network.name(from)),
                      .to = std::string(network.name(to)),
                      .model = {},
                      .at = at,
                      .distance_m = distance(a, b),
                      .walls = network.scene().walls(a, b),
                      .materials = {},
                      .wall_losses = {},
                      .ignores_walls = false,
                      .wall_m = network.scene().wall_length(a, b),
                      .ceilings = floors.ceilings,
                      .ceiling_loss = floors.ceiling_loss,
                      .floors = floors.number,
                      .floor_loss = floors.floor_loss,
                      .sender = stations.radio(from),
                      .receiver = stations.radio(to),
                      .path_loss = links.path_loss(from, to, at, legs),
                      .shadowing = {},
                      .sender_pattern = pattern_gain(stations.radio(from), here, b),
                      .receiver_pattern = pattern_gain(stations.radio(to), there, a),
                      .received = links.level(from, to, at, legs),
                      .margin = links.margin(from, to, at, legs),
                      .up = links.is_up(from, to, at, legs),
                      .why_down = {},
                      .rays = {},
                      .range = range_of(stations.model(from))};
    if (!report.up) report.why_down = why_down(network, from, to, report);
    add_parts(report, network, from, to, a, b);
    return report;
}

void check_two(const Network& network, NodeId a, NodeId b) {
    if (a != b) return;
    throw std::invalid_argument("a link needs two different robots, got \"" + network.name(a) +
                                "\" twice");
}

}  // namespace

LinkReport report_link(const Scenario& scenario, const std::string& from, const std::string& to,
                       Time at, const TellTime& tell) {
    const Scenario played = without_idle_traffic(scenario);
    Network network(network_settings(played));
    populate(network, played);
    const NodeId a = robot_named(network, from), b = robot_named(network, to);
    check_two(network, a, b);
    keep_others_still(network, played, {from, to});
    play_until(network, at, tell);
    return report_at(network, a, b, at);
}

LinkReport report_link(const Network& network, NodeId from, NodeId to) {
    check_two(network, from, to);
    return report_at(network, from, to, network.now());
}

std::vector<BudgetTerm> budget_terms(const LinkReport& report, bool by_wall) {
    const LinkReport& r = report;
    const double shadowing = r.shadowing.value_or(Db{0}).value;
    double rest = r.path_loss.value - shadowing;
    std::vector<BudgetTerm> parts;
    const auto take = [&](std::string what, Db loss) {
        if (!by_wall || loss.value == 0) return;
        rest -= loss.value;
        parts.push_back({std::move(what), -loss.value});
    };
    for (std::size_t i = 0; i < r.wall_losses.size(); ++i) {
        take(fmt::format("wall at {:.1f} m: {}", r.walls[i].entry, r.materials[i]),
             r.wall_losses[i]);
    }
    take("ceilings", r.ceiling_loss);
    take("floors", r.floor_loss);

    std::vector<BudgetTerm> terms = {{"sender's antenna gain", r.sender.antenna_gain.value}};
    if (r.sender.is_directional()) terms.push_back({"sender's pattern", r.sender_pattern.value});
    terms.push_back({"sender's cable loss", -r.sender.cable_loss.value});
    terms.push_back({parts.empty() ? "path loss" : "path loss by distance", -rest});
    terms.insert(terms.end(), parts.begin(), parts.end());
    if (r.shadowing) terms.push_back({"shadowing", -shadowing});
    terms.push_back({"receiver's antenna gain", r.receiver.antenna_gain.value});
    if (r.receiver.is_directional())
        terms.push_back({"receiver's pattern", r.receiver_pattern.value});
    terms.push_back({"receiver's cable loss", -r.receiver.cable_loss.value});
    return terms;
}

Table link_document(const LinkReport& report) {
    Table table;
    table.set("from", report.from);
    table.set("to", report.to);
    table.set("model", report.model);
    table.set("at_s", seconds(report.at));
    table.set("distance_m", report.distance_m);
    Array walls;
    for (std::size_t i = 0; i < report.walls.size(); ++i) {
        Table crossing;
        crossing.set("entry_m", report.walls[i].entry);
        crossing.set("exit_m", report.walls[i].exit);
        crossing.set("length_m", report.walls[i].length);
        crossing.set("material", report.materials[i]);
        Value loss;  // empty: the model gives no level, or no loss of a single wall
        if (!report.wall_losses.empty()) {
            loss = report.wall_losses[i].value;
        } else if (report.ignores_walls && !report.range) {
            loss = 0.0;
        }
        crossing.set("loss_db", std::move(loss));
        walls.emplace_back(std::move(crossing));
    }
    table.set("walls", std::move(walls));
    table.set("wall_m", report.wall_m);
    if (report.ceilings > 0) {
        table.set("ceilings", static_cast<std::uint64_t>(report.ceilings));
        table.set("ceiling_loss_db", report.ceiling_loss.value);
    }
    table.set("floors", static_cast<std::uint64_t>(report.floors));
    table.set("floor_loss_db", report.floor_loss.value);
    if (const auto& rays = report.rays) {
        table.set("paths", static_cast<std::uint64_t>(rays->found));
        table.set("paths_left_out", static_cast<std::uint64_t>(rays->left_out));
        table.set("left_out_db", rays->too_high.value);
    }
    const auto in_db = [&](double value) { return report.range ? Value() : Value(value); };
    if (report.range) table.set("range_m", report.range->value);
    table.set("path_loss_db", in_db(report.path_loss.value));
    if (report.shadowing) table.set("shadowing_db", report.shadowing->value);
    if (report.sender.is_directional()) table.set("sender_pattern_db", report.sender_pattern.value);
    if (report.receiver.is_directional())
        table.set("receiver_pattern_db", report.receiver_pattern.value);
    table.set("rx_power_dbm", in_db(report.received.value));
    table.set("margin_db", in_db(report.margin.value));
    table.set("up", report.up);
    table.set("why_down", report.up ? Value() : Value(report.why_down));
    return table;
}

}  // namespace rovernet
