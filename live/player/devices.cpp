// SPDX-License-Identifier: MIT
#include "live/player/devices.hpp"

#include "live/player/opaque.hpp"
#include "live/player/position2d.hpp"
#include "live/player/range_device.hpp"
#include "live/player/simulation.hpp"
#include "live/player/wifi.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace rovernet {
namespace {

/// Range finders of a robot, by their interface.
std::map<PlayerInterface, std::uint32_t> range_finders_of(const PlayerRobot& robot) {
    std::map<PlayerInterface, std::uint32_t> number;
    for (const Scanner& each : robot.session().range_finders(robot.id())) {
        ++number[player_interface(each)];
    }
    return number;
}

}  // namespace

PlayerDevices::PlayerDevices(Session& session, const std::vector<PlayerPlace>& places) {
    std::map<std::string, PlayerRobot*, std::less<>> by_name;
    for (const PlayerPlace& each : places) {
        const auto robot = session.network().find(each.robot);
        if (!robot) throw std::invalid_argument("there is no robot \"" + each.robot + "\"");
        by_name[each.robot] = &robots_.emplace_back(session, *robot);
        for (const auto& [interface, number] : range_finders_of(robots_.back())) {
            std::uint32_t& most = most_[{each.listener, interface}];
            most = std::max(most, number);
        }
    }
    add(0, 0, 0, std::make_unique<PlayerSimulation>(by_name));
    for (std::size_t i = 0; i < places.size(); ++i) add(i, places[i], *by_name.at(places[i].robot));
}

void PlayerDevices::add(std::size_t number, const PlayerPlace& at, PlayerRobot& robot) {
    const std::size_t listener = at.listener;
    const std::uint32_t index = at.index;
    const std::uint32_t radio = at.radio.value_or(2 * index + 1);
    add(number, listener, index, std::make_unique<PlayerPosition2d>(robot));
    add(number, listener, index, std::make_unique<PlayerWifi>(robot));
    add_range_finders(number, at, robot);
    add(number, listener, radio, std::make_unique<PlayerRadio>(robot, at.has_ttl));
    const std::uint32_t relay = at.relay.value_or(2 * index);
    if (relay != radio) add(number, listener, relay, std::make_unique<PlayerRelay>());
}

void PlayerDevices::add_range_finders(std::size_t number, const PlayerPlace& at,
                                      PlayerRobot& robot) {
    std::map<PlayerInterface, std::uint32_t> next;
    for (std::size_t i = 0; i < robot.session().range_finders(robot.id()).size(); ++i) {
        auto device = std::make_unique<PlayerRangeDevice>(robot, i);
        const PlayerInterface interface = device->interface();
        const std::uint32_t first = most_[{at.listener, interface}] * at.index;
        const std::uint32_t index = first + next[interface]++;
        add(number, at.listener, index, std::move(device));
    }
}

void PlayerDevices::add(std::size_t robot, std::size_t listener, std::uint32_t index,
                        std::unique_ptr<PlayerDevice> device) {
    const PlayerAddress address{device->interface(), index};
    devices_.push_back({listener, address, robot, std::move(device)});
}

PlacedDevice* PlayerDevices::find(std::size_t listener, PlayerAddress address) {
    const auto found = std::find_if(devices_.begin(), devices_.end(), [&](const auto& each) {
        return each.listener == listener && each.address == address;
    });
    return found == devices_.end() ? nullptr : &*found;
}

}  // namespace rovernet
