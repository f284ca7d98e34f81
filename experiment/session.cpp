// SPDX-License-Identifier: MIT
#include "experiment/session.hpp"

#include "experiment/build.hpp"
#include "experiment/client_radios.hpp"
#include "experiment/driven_robots.hpp"
#include "experiment/unknown_cells.hpp"
#include "scenario/document/located.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace rovernet {
namespace {

/// Sentence about a position off the map, with the extent of the map of its storey.
std::string off_map_text(const Scene& scene, Vec3 at) {
    const Scene& storey = scene.storey_at(at.z);
    const Vec3 low = storey.lower_left(), high = storey.upper_right();
    return fmt::format(
        "({:g}, {:g}) m is off the map, which goes from ({:g}, {:g}) to "
        "({:g}, {:g}) m",
        at.x, at.y, low.x, low.y, high.x, high.y);
}

}  // namespace

Session::Session(const Scenario& scenario, std::optional<Router> router)
    : Session(scenario, network_settings(scenario), std::move(router)) {}

Session::Session(const ScenarioFile& file, const Table& settings, std::optional<Router> router)
    : Session(load_scenario(file, settings), std::move(router)) {}

Session::Session(const Scenario& scenario, NetworkSettings settings, std::optional<Router> router)
    : file_(scenario.file),
      network_(std::make_shared<Network>(std::move(settings))),
      end_(start_of_run + scenario.scenario.duration),
      driven_(std::make_unique<DrivenRobots>(*network_)),
      radios_(std::make_unique<ClientRadios>(*network_)) {
    router ? populate(*network_, scenario, std::move(*router)) : populate(*network_, scenario);
    for (const RobotTable& table : scenario.robots) {
        if (table.scan.empty()) continue;
        const auto scanners = std::make_shared<const std::vector<Scanner>>(table.scan);
        for (int i = 0; i < table.count.value_or(1); ++i) {
            range_finders_[*network_->find(table.name_of(i))] = scanners;
        }
    }
}

Session::~Session() = default;

bool Session::is_stalled(NodeId robot) const { return driven_->is_stalled(robot); }
bool Session::has_no_way(NodeId robot) const { return driven_->has_no_way(robot); }
Twist Session::twist(NodeId robot) const { return driven_->twist(robot); }

bool Session::advance(Time until, std::uint64_t most_events, Time limit) {
    // A fault that a model finds only when its turn comes is the scenario's, too.
    return located(Location{file_}, [&] {
        return network_->advance(std::min(until, end_), most_events, std::min(limit, end_));
    });
}

bool Session::run(std::optional<double> speed, const std::function<bool(double)>& progress) {
    using WallClock = std::chrono::steady_clock;
    constexpr std::uint64_t events_a_slice = 256;  // each may reach thousands of robots
    constexpr double longest_wait_s = 0.05;
    const auto started = WallClock::now();
    const Time begun = network_->now();
    for (;;) {
        Time until = end_;
        if (speed) {
            const std::chrono::duration<double> wall = WallClock::now() - started;
            until = begun + from_seconds(std::min(wall.count() * *speed, seconds(end_ - begun)));
        }
        const bool arrived = advance(until, events_a_slice, end_);
        const bool done = arrived && until == end_;
        const double share = seconds(network_->now()) / seconds(end_);
        if (progress && !progress(share)) return false;
        if (done) return true;
        if (speed && network_->now() >= until) {
            std::this_thread::sleep_for(std::chrono::duration<double>(longest_wait_s));
        }
    }
}

ClientId Session::attach(const std::vector<NodeId>& robots, std::string name, bool hears) {
    for (const NodeId robot : robots) {
        const std::string robot_name = network_->name(robot);
        if (drivers_.contains(robot)) {
            throw std::invalid_argument(
                fmt::format("robot {} is already driven by a different client", robot_name));
        }
        if (std::count(robots.begin(), robots.end(), robot) > 1) {
            throw std::invalid_argument(fmt::format("robot {} is listed twice", robot_name));
        }
    }
    const ClientId client = attach_radios(robots, std::move(name), hears);
    for (const NodeId robot : robots) drivers_[robot] = client;
    return client;
}

ClientId Session::attach_radios(const std::vector<NodeId>& robots, std::string name, bool hears) {
    const ClientId client = next_client_++;
    clients_[client] = {.name = std::move(name), .robots = robots};
    radios_->join(client, robots, hears);   // first, so that frames of this time have levels
    advance(network_->now(), every_event);  // a command comes after all events of its time
    radios_->heard(client);                 // what came before the client
    return client;
}

void Session::detach(ClientId client) {
    const std::vector<NodeId>& robots = client_of(client).robots;
    for (const NodeId robot : robots) {
        if (driver(robot) != client) continue;
        carry_out(client, robot, StopCommand{});
        drivers_.erase(robot);
    }
    radios_->leave(client);
    clients_.erase(client);
}

std::optional<ClientId> Session::driver(NodeId robot) const {
    const auto found = drivers_.find(robot);
    return found == drivers_.end() ? std::nullopt : std::optional(found->second);
}

const Session::Client& Session::client_of(ClientId client) const {
    const auto found = clients_.find(client);
    if (found == clients_.end())
        throw std::invalid_argument("no client with this id is attached to the session");
    return found->second;
}

void Session::check_robot(ClientId client, NodeId robot) const {
    client_of(client);
    if (driver(robot) == client) return;
    throw std::invalid_argument(fmt::format(
        "robot {} is not attached to this client: attach the robot first", network_->name(robot)));
}

std::optional<std::uint64_t> Session::carry_out(ClientId client, NodeId robot,
                                                const RobotCommand& command, std::uint64_t number) {
    const bool sends = std::holds_alternative<SendCommand>(command);
    if (!sends || !radios_->has(client, robot)) check_robot(client, robot);
    // A command that cannot be carried out must not be in a log, which could not be replayed.
    const std::string why = sends ? why_not(robot, command) : "";
    if (!why.empty()) throw std::invalid_argument(why);
    advance(network_->now(), every_event);  // what the last command caused at this time comes first
    if (tell_) tell_({network_->now(), robot, client_of(client).name, number, command});
    std::optional<std::uint64_t> uid;
    const auto act = [&](const auto& each) {
        if constexpr (requires { each.carry_out(*driven_, robot); }) {
            each.carry_out(*driven_, robot);
        } else {
            uid = radios_->send(robot, each);
        }
    };
    std::visit(act, command);
    return uid;
}

void Session::move(ClientId client, NodeId robot, Movement movement) {
    check_robot(client, robot);
    driven_->move(robot, std::move(movement));
}

std::vector<HeardMessage> Session::heard(ClientId client) {
    client_of(client);
    return radios_->heard(client);
}

void Session::set_hearing(ClientId client, bool hears) {
    client_of(client);
    radios_->set_hearing(client, hears);
}

std::string Session::why_not(NodeId robot, const RobotCommand& command) const {
    const Scene& scene = network_->scene();
    if (const auto* goal = std::get_if<GoalCommand>(&command)) {
        return scene.inside_map(goal->to) ? "" : off_map_text(scene, goal->to);
    }
    if (const auto* send = std::get_if<SendCommand>(&command); send && send->to == robot) {
        return "a robot cannot send to itself; expected another robot, or no robot for a message "
               "to everyone";
    }
    const auto* place = std::get_if<PlaceCommand>(&command);
    return place ? why_not_at(robot, place->at) : "";
}

std::string Session::why_not_at(NodeId robot, Vec3 at) const {
    const Scene& storey = network_->scene().storey_at(at.z);
    const Vec3 low = storey.lower_left(), high = storey.upper_right();
    const bool is_on_map = at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y;
    if (storey.has_border() && !is_on_map) return off_map_text(network_->scene(), at);
    const Storeys& storeys = network_->scene().storeys();
    if (const std::size_t top = storeys.size() - 1; top > 0) {
        const double lowest = storeys.floor(0), highest = storeys.floor(top);
        const double above = highest - storeys.floor(top - 1);
        if (at.z < lowest || at.z >= highest + above)
            return fmt::format("a height of {:g} m is on no storey; floors are at {:g} to {:g} m",
                               at.z, lowest, highest);
    }
    const double radius = network_->robot(robot).radius.value;
    if (network_->scene().clearance(at) >= radius) return "";
    const std::string whose = fmt::format("robot {}'s radius", network_->name(robot));
    const std::string unknown = unknown_cell_text(network_->scene(), at, {radius}, whose);
    if (!unknown.empty()) return fmt::format("({:g}, {:g}) m {}", at.x, at.y, unknown);
    return fmt::format(
        "({:g}, {:g}) m is in a wall, or nearer to a wall than the radius of robot {} ({:g} m)",
        at.x, at.y, network_->name(robot), radius);
}

std::span<const Scanner> Session::range_finders(NodeId robot) const {
    const auto found = range_finders_.find(robot);
    return found == range_finders_.end() ? std::span<const Scanner>{} : *found->second;
}

std::vector<double> Session::scan(NodeId robot, std::size_t number) const {
    const Scanner& scanner = range_finders_.at(robot)->at(number);
    std::vector<RoundBody> others;
    const auto storey_of = [&](Vec3 at) { return network_->scene().storeys().number_at(at.z); };
    const std::size_t storey = storey_of(network_->position(robot));
    for (NodeId other{0}; other.index() < network_->size(); ++other.value) {
        const RobotState state = network_->robot(other);
        const bool is_there = state.presence == Presence::on || state.presence == Presence::off;
        if (other != robot && is_there && storey_of(state.at) == storey)
            others.push_back({state.at, state.radius});
    }
    std::vector<double> ranges(scanner.size());
    scanner.measure(network_->scene(), {network_->position(robot), network_->heading(robot)},
                    others, ranges);
    return ranges;
}

}  // namespace rovernet
