// SPDX-License-Identifier: MIT
#include "experiment/session.hpp"

#include "experiment/build.hpp"
#include "mobility/driven.hpp"
#include "scenario/located.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace rovernet {

Session::Session(const Scenario& scenario) : Session(scenario, network_settings(scenario)) {}

Session::Session(const Scenario& scenario, NetworkSettings settings)
    : file_(scenario.file),
      network_(std::make_shared<Network>(std::move(settings))),
      end_(start_of_run + scenario.scenario.duration) {
    populate(*network_, scenario);
}

Session::~Session() {
    for (auto& [id, client] : clients_) {
        for (Subscription& each : client.subscriptions) each.end();
    }
}

/// Serves events until `until`, and at most so many. @return true once that time is reached
bool Session::advance(Time until, std::uint64_t most_events) {
    // A fault that a model finds only when its turn comes is the scenario's, too.
    return located(Location{file_},
                   [&] { return network_->advance(std::min(until, end_), most_events); });
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
            until = std::min(end_, begun + from_seconds(wall.count() * *speed));
        }
        const bool arrived = advance(until, events_a_slice);
        const bool done = arrived && until == end_;
        const double share = seconds(network_->now()) / seconds(end_);
        if (progress && !progress(share)) return false;
        if (done) return true;
        if (speed && network_->now() >= until) {
            std::this_thread::sleep_for(std::chrono::duration<double>(longest_wait_s));
        }
    }
}

ClientId Session::attach(const std::vector<NodeId>& robots) {
    for (const NodeId robot : robots) {
        const std::string name = network_->name(robot);
        if (drivers_.contains(robot)) {
            throw std::invalid_argument(
                fmt::format("robot {} is driven by another client already", name));
        }
        if (std::count(robots.begin(), robots.end(), robot) > 1) {
            throw std::invalid_argument(fmt::format("robot {} is listed twice", name));
        }
    }
    const ClientId id = next_client_++;
    Client& client = clients_[id];
    client.robots = robots;
    for (const NodeId robot : robots) {
        drivers_[robot] = id;
        client.subscriptions.push_back(network_->on_receive(
            robot, [this, id, robot](const Message& message, const Heard& how) {
                clients_.at(id).heard.push_back(
                    {network_->now(), robot, message.origin, how.hops, message.payload});
            }));
    }
    return id;
}

void Session::detach(ClientId client) {
    for (Subscription& each : client_of(client).subscriptions) each.end();
    for (const NodeId robot : client_of(client).robots) {
        network_->stop(robot);
        drivers_.erase(robot);
        driving_.erase(robot);
    }
    clients_.erase(client);
}

Session::Client& Session::client_of(ClientId client) {
    const auto found = clients_.find(client);
    if (found == clients_.end()) throw std::invalid_argument("there is no such client");
    return found->second;
}

void Session::check_robot(ClientId client, NodeId robot) {
    const auto& robots = client_of(client).robots;
    if (std::find(robots.begin(), robots.end(), robot) != robots.end()) return;
    throw std::invalid_argument(
        fmt::format("robot {} is not the client's: attach it first", network_->name(robot)));
}

void Session::drive(ClientId client, NodeId robot, MetersPerSecond speed,
                    RadiansPerSecond turn_rate, std::optional<Duration> timeout) {
    check_robot(client, robot);
    Driven driven{.speed = speed, .turn_rate = turn_rate};
    if (timeout) driven.until = network_->now() + *timeout;
    driving_.erase(robot);
    if (speed.value != 0) driving_[robot] = driven.until.value_or(never);
    network_->move(robot, driven);
}

void Session::move(ClientId client, NodeId robot, Movement movement) {
    check_robot(client, robot);
    driving_.erase(robot);
    network_->move(robot, std::move(movement));
}

void Session::send(ClientId client, NodeId robot, std::optional<NodeId> to, std::string payload) {
    check_robot(client, robot);
    if (to) {
        network_->unicast(robot, *to, std::move(payload));
    } else {
        network_->broadcast(robot, std::move(payload));
    }
}

std::vector<HeardMessage> Session::heard(ClientId client) {
    auto heard = std::exchange(client_of(client).heard, {});
    std::stable_sort(heard.begin(), heard.end(), [](const auto& a, const auto& b) {
        return a.time != b.time ? a.time < b.time : a.at < b.at;
    });
    return heard;
}

bool Session::is_stalled(NodeId robot) const {
    const auto driving = driving_.find(robot);
    if (driving == driving_.end() || network_->now() >= driving->second) return false;
    return network_->legs().leg(robot).velocity == Vec3{};
}

}  // namespace rovernet
