// SPDX-License-Identifier: MIT
#pragma once

#include "live/player/front.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/live/player/wire.hpp"
#include "test/live/run_front.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace rovernet::test {

inline Scenario player_scenario(const std::string& text) {
    const TemporaryFolder folder;
    return load_scenario(folder.write("player.toml", text), {});
}

/// Player clients and a session without sockets and clock: the test passes the bytes, and advances
/// the time.
class PlayerTalk {
  public:
    explicit PlayerTalk(Scenario scenario, PlayerSettings settings = {})
        : scenario_(std::move(scenario)),
          session(scenario_),
          front(placed(std::move(settings)),
                {.send = [this](auto to, auto bytes) { told_[to] += bytes; },
                 .close = [this](auto which) { closed.insert(which); }}) {
        session.network().add_sink(fingerprint);
        session.step(start_of_run);
        front.begin(session, scenario_);
    }

    /// Connects a new client and removes the banner from its input.
    Front::Connection come(std::size_t listener = 0) {
        const Front::Connection client = next_client_++;
        front.opened(client, {listener, static_cast<std::uint16_t>(6665 + listener)});
        told_[client].erase(0, 32);
        return client;
    }
    void say(Front::Connection client, const std::string& bytes) { front.received(client, bytes); }
    void go(Front::Connection client) { front.closed(client); }
    /// Messages that a client has received since the last call.
    std::vector<Wire> told(Front::Connection client) { return take_messages(told_[client]); }
    std::vector<Wire> ask(Front::Connection client, const std::string& bytes) {
        told(client);
        say(client, bytes);
        return told(client);
    }

    void run_until(Duration time) { run_front(session, front, start_of_run + time); }
    void run_for(Duration time) { run_until(session.network().now().time_since_epoch() + time); }

  private:
    /// Settings with robot k at listener k, unless `settings` place robots otherwise.
    PlayerSettings placed(PlayerSettings settings) const {
        if (!settings.places.empty()) return settings;
        for (const RobotTable& robot : scenario_.robots) {
            settings.places.push_back({robot.name, settings.places.size(), 0});
        }
        return settings;
    }

    Scenario scenario_;
    std::map<Front::Connection, std::string> told_;
    Front::Connection next_client_ = 0;

  public:
    std::set<Front::Connection> closed;
    Session session;
    PlayerFront front;
    const std::shared_ptr<Fingerprint> fingerprint = std::make_shared<Fingerprint>();
};

}  // namespace rovernet::test
