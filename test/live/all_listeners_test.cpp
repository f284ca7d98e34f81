// SPDX-License-Identifier: MIT
// Paced runs with all kinds of listeners, with clients of every kind at once that do something
// all the time: such a run is made again from its log. The long forms are skipped here; .ci/full
// runs them, and the one with 50 clients under the thread sanitizer.
#include "live/emulate/listeners.hpp"
#include "live/player/listeners.hpp"
#include "live/rosbridge/listener.hpp"
#include "scenario/scenario_file.hpp"
#include "test/live/busy_clients.hpp"
#include "test/live/served_run.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <string>
#include <utility>
#include <vector>

namespace all_listeners_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// Four robots that hear one another, one of which wanders, and the traffic of the scenario itself.
Scenario four_robots(Duration duration) {
    const TemporaryFolder folder;
    Scenario scenario = load_scenario(folder.write("four.toml", R"([scenario]
name = "four"
[access]
model = "csma"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["10 m", "0 m"]
[[robot]]
name = "C"
at = ["20 m", "0 m"]
[[robot]]
name = "D"
at = ["0 m", "10 m"]
move = { model = "patrol", path = [["20 m", "10 m"], ["0 m", "10 m"]], speed = "1 m/s" }
[[traffic]]
from = "D"
payload = "tick"
every = "70 ms"
)"),
                                      {});
    scenario.scenario.duration = duration;
    return scenario;
}

/// Time of the last input in a log that has these words; 0 if none has.
Duration last_input(const std::string& log, const std::string& words) {
    const std::string key = "{\"t_ns\":";
    const std::size_t found = log.rfind(words);
    if (found == log.npos) return {};
    return Duration{std::stoll(log.substr(log.rfind(key, found) + key.size(), 20))};
}

/// Clients in threads of their own.
class Crowd {
  public:
    explicit Crowd(const ServedRun& run) : run_(run) {}
    ~Crowd() { goes_on_ = false; }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    void add_player(const std::string& robot, std::uint32_t how) {
        LineClient client(run_.port("(Player, robot " + robot + ")"));
        start([how](LineClient& own) { return player_client(std::move(own), how); },
              std::move(client));
    }
    void add_ros(const std::string& robot) {
        WebClient client(run_.port("(rosbridge)"));
        start([robot](WebClient& own) { return ros_client(std::move(own), robot); },
              std::move(client));
    }
    /// @param other  number of another robot
    void add_program(const std::string& robot, char other) {
        start([this, other](int port) { return packet_program(port, other, goes_on_); },
              run_.port("(robot " + robot + ")"));
    }
    /// Checks, as the run has ended, that each has said and heard something.
    void check() {
        goes_on_ = false;
        for (auto& each : clients_) {
            const Busy busy = each.get();
            CHECK(busy.said > 0);
            CHECK(busy.heard > 0);
        }
    }

  private:
    template <class Act, class Client>
    void start(Act act, Client client) {
        clients_.push_back(std::async(
            std::launch::async, [act](Client own) { return act(own); }, std::move(client)));
    }

    const ServedRun& run_;
    std::atomic<bool> goes_on_ = true;
    std::vector<std::future<Busy>> clients_;
};

/// A run with so many clients of each kind that has a connection, and a program at each of so many
/// robots: a port answers to whoever has spoken last.
void check_run(Duration duration, int of_each_kind) {
    const std::string robots[] = {"A", "B", "C", "D"};
    const Scenario scenario = four_robots(duration);
    const Address any{"127.0.0.1", 0};
    ServedRun run(
        scenario,
        {player_ports(any, robot_names(scenario), {}), rosbridge_listener(any), udp_relay(any)},
        2 * scenario.robots.size() + 1);
    Crowd crowd(run);
    for (int i = 0; i < of_each_kind; ++i) {
        crowd.add_player("A", push);
        crowd.add_player(i % 2 == 0 ? "B" : "A", pull);
        crowd.add_ros(i % 2 == 0 ? "C" : "D");
        if (i < 4) crowd.add_program(robots[i], static_cast<char>((i + 1) % 4));
    }
    const LiveResult result = run.end();
    crowd.check();
    const std::string log = run.log();
    for (const char* kind :
         {R"("client":"player")", R"("client":"rosbridge")", R"("client":"programs")"}) {
        CAPTURE(kind);
        CHECK(last_input(log, kind) > duration / 2);
    }
    const InputReplay replay = run.replay();
    CHECK(result.run.simulated == duration);
    CHECK(replay.recorded == result.run.fingerprint);
    CHECK(replay.now == result.run.fingerprint);
}

}  // namespace

TEST_CASE("all listeners: a run with four kinds of clients is reproduced from its input log") {
    check_run(3s, 1);
}

TEST_CASE(
    "all listeners: a run of 60 s with four kinds of clients is reproduced from its input log" *
    doctest::skip()) {
    check_run(60s, 1);
}

TEST_CASE("all listeners: a run with 52 clients of four kinds is reproduced from its input log") {
    check_run(2s, 16);
}

}  // namespace all_listeners_test
