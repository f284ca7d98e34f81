// SPDX-License-Identifier: MIT
// Runs by the clock whose doors are all open, with clients of every kind at once that do something
// all the time: such a run is made again from its log. The long forms are skipped here; .ci/full
// runs them, and the one with 50 clients under the thread sanitizer.
#include "live/emulate/door.hpp"
#include "live/input_log.hpp"
#include "live/paced_run.hpp"
#include "live/player/door.hpp"
#include "live/rosbridge/door.hpp"
#include "test/live/busy_clients.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace all_doors_test {
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

/// A run in a thread of its own: Player ports of the robots, a port of rosbridge, UDP ports.
class AllDoors {
  public:
    explicit AllDoors(const Scenario& scenario) {
        const Address any{"127.0.0.1", 0};
        PacedOptions options;
        options.folder = folder_.path("out");
        options.fronts = {player_ports(any, robot_names(scenario), {}), rosbridge_door(any),
                          udp_relay(any)};
        const std::size_t doors = 2 * scenario.robots.size() + 1;
        options.say = [this, doors](std::string_view text) {
            if (!text.starts_with("listening on ") || said_.size() == doors) return;
            said_.emplace_back(text);
            if (said_.size() == doors) opened_.set_value();
        };
        run_ = std::async(std::launch::async,
                          [options, scenario] { return run_paced(scenario, options); });
        opened_.get_future().wait();
    }

    /// Port of the address that is for this: "(rosbridge)".
    int port(const std::string& what) const {
        const std::string host = "127.0.0.1:";
        for (const std::string& line : said_) {
            if (line.ends_with(what)) return std::stoi(line.substr(line.find(host) + host.size()));
        }
        FAIL("no door for " << what);
        return 0;
    }
    LiveResult end() { return run_.get(); }
    InputReplay replay() const { return replay_inputs(folder_.path("out"), {}); }
    /// Time of the last input in the log that has these words; 0 if none has.
    Duration last_input(const std::string& words) const {
        const std::string key = "{\"t_ns\":";
        std::ifstream log(folder_.path("out/inputs.jsonl"));
        Duration last{};
        for (std::string line; std::getline(log, line);) {
            if (line.find(words) == line.npos) continue;
            last = Duration{std::stoll(line.substr(key.size()))};
        }
        return last;
    }

  private:
    TemporaryFolder folder_;
    std::vector<std::string> said_;
    std::promise<void> opened_;
    std::future<LiveResult> run_;
};

/// Clients in threads of their own.
class Crowd {
  public:
    explicit Crowd(const AllDoors& doors) : doors_(doors) {}
    ~Crowd() { goes_on_ = false; }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    void add_player(const std::string& robot, std::uint32_t how) {
        LineClient client(doors_.port("(Player, robot " + robot + ")"));
        start([how](LineClient& own) { return player_client(std::move(own), how); },
              std::move(client));
    }
    void add_ros(const std::string& robot) {
        WebClient client(doors_.port("(rosbridge)"));
        start([robot](WebClient& own) { return ros_client(std::move(own), robot); },
              std::move(client));
    }
    /// @param other  number of another robot
    void add_program(const std::string& robot, char other) {
        start([this, other](int port) { return packet_program(port, other, goes_on_); },
              doors_.port("(robot " + robot + ")"));
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

    const AllDoors& doors_;
    std::atomic<bool> goes_on_ = true;
    std::vector<std::future<Busy>> clients_;
};

/// A run with so many clients of each kind that has a connection, and a program at each of so many
/// robots: a port answers to whoever has spoken last.
void check_run(Duration duration, int of_each_kind) {
    const std::string robots[] = {"A", "B", "C", "D"};
    AllDoors doors(four_robots(duration));
    Crowd crowd(doors);
    for (int i = 0; i < of_each_kind; ++i) {
        crowd.add_player("A", push);
        crowd.add_player(i % 2 == 0 ? "B" : "A", pull);
        crowd.add_ros(i % 2 == 0 ? "C" : "D");
        if (i < 4) crowd.add_program(robots[i], static_cast<char>((i + 1) % 4));
    }
    const LiveResult result = doors.end();
    crowd.check();
    for (const char* kind :
         {R"("client":"player")", R"("client":"rosbridge")", R"("client":"programs")"}) {
        CAPTURE(kind);
        CHECK(doors.last_input(kind) > duration / 2);
    }
    const InputReplay replay = doors.replay();
    CHECK(result.run.simulated == duration);
    CHECK(replay.recorded == result.run.fingerprint);
    CHECK(replay.now == result.run.fingerprint);
}

}  // namespace

TEST_CASE("all doors: a run with four kinds of clients is made again from its log") {
    check_run(3s, 1);
}

TEST_CASE("all doors: a run of 60 s with four kinds of clients is made again from its log" *
          doctest::skip()) {
    check_run(60s, 1);
}

TEST_CASE("all doors: a run with 52 clients of four kinds is made again from its log") {
    check_run(2s, 16);
}

}  // namespace all_doors_test
