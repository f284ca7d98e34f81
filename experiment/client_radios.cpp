// SPDX-License-Identifier: MIT
#include "experiment/client_radios.hpp"

#include <algorithm>
#include <utility>

namespace rovernet {

ClientRadios::~ClientRadios() {
    for (auto& [robot, listeners] : listeners_) listeners.subscription.end();
}

void ClientRadios::join(ClientId client, const std::vector<NodeId>& robots, bool hears) {
    clients_[client] = {.robots = robots};
    set_hearing(client, hears);
}

void ClientRadios::leave(ClientId client) {
    if (!clients_.contains(client)) return;
    set_hearing(client, false);
    clients_.erase(client);
}

void ClientRadios::listen(ClientId client, NodeId robot) {
    Listeners& listeners = listeners_[robot];
    listeners.clients.push_back(client);
    if (listeners.clients.size() > 1) return;
    listeners.subscription = network_.on_receive(
        robot, [this, robot](const Heard& heard) { hear(robot, heard); }, {.level = true});
}

void ClientRadios::stop_listening(ClientId client, NodeId robot) {
    Listeners& listeners = listeners_.at(robot);
    std::erase(listeners.clients, client);
    if (!listeners.clients.empty()) return;
    listeners.subscription.end();
    listeners_.erase(robot);
}

void ClientRadios::hear(NodeId robot, const Heard& heard) {
    const Message& message = heard.message;
    for (const ClientId each : listeners_.at(robot).clients) {
        clients_.at(each).heard.push_back({.time = network_.now(),
                                           .at = robot,
                                           .from = message.origin,
                                           .hops = heard.hops,
                                           .payload = message.payload,
                                           .last_hop = heard.last_hop,
                                           .level = heard.level,
                                           .port = message.port,
                                           .is_for_everyone = message.to == everyone});
    }
}

bool ClientRadios::has(ClientId client, NodeId robot) const {
    const auto found = clients_.find(client);
    if (found == clients_.end()) return false;
    const std::vector<NodeId>& robots = found->second.robots;
    return std::find(robots.begin(), robots.end(), robot) != robots.end();
}

std::optional<std::uint64_t> ClientRadios::send(NodeId robot, const SendCommand& command) {
    return network_.send(robot, command.to.value_or(everyone), command.payload,
                         {.size = command.size, .port = command.port, .one_hop = command.one_hop});
}

std::vector<HeardMessage> ClientRadios::heard(ClientId client) {
    auto heard = std::exchange(clients_.at(client).heard, {});
    std::stable_sort(heard.begin(), heard.end(), [](const auto& a, const auto& b) {
        return a.time != b.time ? a.time < b.time : a.at < b.at;
    });
    return heard;
}

void ClientRadios::set_hearing(ClientId id, bool hears) {
    Client& client = clients_.at(id);
    if (std::exchange(client.hears, hears) == hears) return;
    for (const NodeId robot : client.robots) {
        hears ? listen(id, robot) : stop_listening(id, robot);
    }
    if (!hears) client.heard.clear();
}

}  // namespace rovernet
