// SPDX-License-Identifier: MIT
// live COMMAND: what programs outside cost `COMMAND live`, and how long they wait for it, beside
// the goals. Times are medians; a line that goes there and back between two threads tells what the
// system itself takes at that moment. Runs alone: with others a program waits for its turn.
#include "bench/served.hpp"
#include "test/live/line_client.hpp"
#include "test/live/player/wire.hpp"
#include "test/live/web_client.hpp"
#include "test/scene/temporary_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <list>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

using namespace rovernet;
using namespace rovernet::bench;
using namespace rovernet::test;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
    return std::chrono::duration<double>(Clock::now() - begun).count();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Median time [us] of a call, after a tenth of them that do not count.
template <class Call>
double microseconds(int times, Call call) {
    for (int i = 0; i < times / 10; ++i) call();
    std::vector<double> took;
    for (int i = 0; i < times; ++i) {
        const auto begun = Clock::now();
        call();
        took.push_back(1e6 * seconds_since(begun));
    }
    return median(std::move(took));
}

/// @param goal  largest value; 0: none
void print_row(std::string_view what, double value, std::string_view unit, double goal = 0) {
    double load = 0;
    getloadavg(&load, 1);
    fmt::print("{:<52}{:>10.2f} {:<3}", what, value, unit);
    goal > 0 ? fmt::print("{:>7g}{:>7.2f}", goal, value / goal) : fmt::print("{:14}", "");
    fmt::print("{:>7.1f}\n", load);
    std::fflush(stdout);
}

/// Prints how much more one run takes than another: the least CPU time of five counts, as what
/// others do on the machine never takes any off.
template <class Less, class More>
void print_more(std::string_view what, Less less, More more, double goal) {
    constexpr int rounds = 5;
    double least = 1e9, least_more = 1e9;
    for (int i = 0; i < rounds; ++i) {
        least = std::min(least, less());
        least_more = std::min(least_more, more());
    }
    print_row(what, 100 * (least_more / least - 1), "%", goal);
}

/// Robots 10 m apart in an open field. Nothing happens there but what clients do, or `more`.
std::string field(int robots, std::string_view duration, const std::string& more = {}) {
    std::string text = fmt::format("[scenario]\nname = \"field\"\nduration = \"{}\"\n", duration);
    text += more;
    for (int i = 0; i < robots; ++i) {
        text += fmt::format("[[robot]]\nname = \"r{}\"\nat = [\"{} m\", \"{} m\"]\n", i,
                            10 * (i % 10), 10 * (i / 10));
    }
    return text;
}

/// The runs of the command that are measured.
class Bench {
  public:
    explicit Bench(std::string command) : command_(std::move(command)) {}

    void exchange(int robots, double goal, bool by_columns = false) const;
    void reset() const;
    void player_round() const;
    void ros_round() const;
    void nobody() const;
    void deaf(const std::string& topic) const;
    void crowd() const;

  private:
    Served live(const std::string& scenario, std::vector<std::string> options) const {
        options.insert(options.begin(), {command_, "live", scenario, "--out", folder_.path("out")});
        return Served(options);
    }
    /// CPU time [s] of a run by the clock while so many clients read nothing of a topic.
    double beside_deaf(const std::string& scenario, const std::string& topic, int clients) const;

    std::string command_;
    TemporaryFolder folder_;
};

std::string hello(int robots, bool by_columns) {
    std::string names;
    for (int i = 0; i < robots; ++i) names += fmt::format("{}\"r{}\"", i == 0 ? "" : ",", i);
    return fmt::format(
        R"({{"type":"hello","protocol":1,"robots":[{}],"step":"100 ms","columns":{}}})", names,
        by_columns);
}

/// What a step tells each robot, as an object by name or as columns.
std::string commands(int robots, bool by_columns) {
    if (by_columns) {
        std::string ids, v, w;
        for (int i = 0; i < robots; ++i) {
            const char* comma = i == 0 ? "" : ",";
            ids += fmt::format("{}{}", comma, i);
            v += fmt::format("{}0.5", comma);
            w += fmt::format("{}0.1", comma);
        }
        return fmt::format(R"({{"robots":[{}],"v":[{}],"w":[{}]}})", ids, v, w);
    }
    std::string text;
    for (int i = 0; i < robots; ++i) {
        text += fmt::format(R"({}"r{}":{{"v":0.5,"w":0.1}})", i == 0 ? "{" : ",", i);
    }
    return text + "}";
}

void Bench::exchange(int robots, double goal, bool by_columns) const {
    Served served =
        live(folder_.write("field.toml", field(robots, "1e6 s")), {"--listen-json", "127.0.0.1:0"});
    LineClient client(served.port());
    client.ask(hello(robots, by_columns));
    const std::string words = commands(robots, by_columns);
    int n = 0;
    const double took = microseconds(
        3000, [&] { client.ask(fmt::format(R"({{"type":"step","n":{},"do":{}}})", ++n, words)); });
    print_row(fmt::format("lock-step, {} robot{}{}", robots, robots == 1 ? "" : "s",
                          by_columns ? " by columns" : ""),
              took, "us", goal);
    client.ask(R"({"type":"bye"})");
}

void Bench::reset() const {
    constexpr int robots = 10;
    Served served =
        live(folder_.write("field.toml", field(robots, "1e6 s")), {"--listen-json", "127.0.0.1:0"});
    LineClient client(served.port());
    client.ask(hello(robots, false));
    const double took = microseconds(50, [&] { client.ask(R"({"type":"reset"})"); });
    print_row("reset of a session, 10 robots", took / 1e3, "ms", 5);
    client.ask(R"({"type":"bye"})");
}

/// Reads a Player message. @return its type
std::uint64_t take_message(LineClient& client) {
    const std::string header = client.bytes(40);
    client.bytes(number_at(header, 36, 4));
    return number_at(header, 16, 4);
}

void Bench::player_round() const {
    Served served = live(folder_.write("field.toml", field(1, "1e6 s")),
                         {"--player", "127.0.0.1:0", "--player-lockstep"});
    LineClient client(served.port());
    client.bytes(32);
    client.send_bytes(mode(pull) + device(4, 0));
    for (int i = 0; i < 2; ++i) take_message(client);
    const double took = microseconds(3000, [&] {
        client.send_bytes(drive(1, 0));
        client.send_bytes(ask());
        while (take_message(client) != sync_message) {
        }
    });
    print_row("Player, a command and Read() in lock-step", took, "us", 200);
}

void Bench::ros_round() const {
    Served served = live(folder_.write("field.toml", field(1, "1e6 s")),
                         {"--rosbridge", "127.0.0.1:0", "--speed", "1e6"});
    WebClient client(served.port());
    client.ask(R"({"op":"call_service","id":"p","service":"/simulation/pause"})");
    client.send(R"({"op":"subscribe","topic":"/r0/odom"})");
    const double took = microseconds(3000, [&] {
        client.send(R"({"op":"publish","topic":"/r0/cmd_vel","msg":{"linear":{"x":0.5}}})");
        client.send(
            R"({"op":"call_service","id":"s","service":"/simulation/step","args":{"seconds":0.05}})");
        for (int i = 0; i < 2; ++i) client.message();  // odometry and the answer
    });
    print_row("rosbridge, cmd_vel to the next odom, by steps", took, "us", 200);
    served.interrupt();
}

/// Messages that flood a hundred robots.
std::string talk(std::string_view every) {
    return fmt::format(
        "[routing]\nprotocol = \"flood\"\nttl = 20\n[[traffic]]\nfrom = \"r0\"\n"
        "payload = \"tick\"\nevery = \"{}\"\n",
        every);
}

void Bench::nobody() const {
    const std::string scenario = folder_.write("talk.toml", field(100, "10 s", talk("2 ms")));
    print_more(
        "CPU time, a door and nobody there, over run",
        [&] {
            return Served({command_, "run", scenario, "--out", folder_.path("run")}).end();
        },
        [&] {
            return live(scenario, {"--rosbridge", "127.0.0.1:0", "--speed", "1e9"}).end();
        },
        1);
}

double Bench::beside_deaf(const std::string& scenario, const std::string& topic,
                          int clients) const {
    Served served = live(scenario, {"--rosbridge", "127.0.0.1:0"});
    const int port = served.port();
    std::list<WebClient> deaf;
    for (int i = 0; i < clients; ++i) {
        deaf.emplace_back(port).send(fmt::format(R"({{"op":"subscribe","topic":"{}"}})", topic));
    }
    return served.end();
}

void Bench::deaf(const std::string& topic) const {
    const std::string scenario = folder_.write("talk.toml", field(100, "5 s", talk("500 us")));
    print_more(
        fmt::format("CPU time, 10 clients of {} never read, over none", topic),
        [&] { return beside_deaf(scenario, topic, 0); },
        [&] { return beside_deaf(scenario, topic, 10); }, 2);
}

void Bench::crowd() const {
    constexpr int each = 500;
    Served served = live(folder_.write("field.toml", field(1, "1e6 s")),
                         {"--player", "127.0.0.1:0", "--rosbridge", "127.0.0.1:0"});
    const int player = served.port(), rosbridge = served.port();
    const double before = served.memory();
    std::list<LineClient> lines;
    std::list<WebClient> webs;
    int here = 0;
    for (int i = 0; i < each; ++i) here += lines.emplace_back(player).bytes(32).size() == 32;
    for (int i = 0; i < each; ++i) here += webs.emplace_back(rosbridge).is_in();
    print_row("connections at once, of 1,000 by two doors", here, "");
    print_row("memory of each", (served.memory() - before) / here / 1024, "KiB", 16);
    served.interrupt();
    const auto begun = Clock::now();
    served.end();
    print_row("Ctrl-C with all of them there", seconds_since(begun), "s", 1);
}

/// A line there and back between two threads, by TCP on this machine.
void echo() {
    Listener listener;
    std::thread other([&] { listener.echo(); });
    {
        LineClient client(listener.port());
        print_row("a line there and back, without rovernet",
                  microseconds(3000, [&] { client.ask("line"); }), "us");
    }
    other.join();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: live COMMAND, with the rovernet command to measure\n");
        return 2;
    }
    try {
        const Bench bench(argv[1]);
        fmt::print("{:<52}{:>14}{:>7}{:>7}{:>7}\n", "", "median", "goal", "ratio", "load");
        echo();
        bench.exchange(1, 25);
        bench.exchange(10, 50);
        bench.exchange(100, 100);
        bench.exchange(100, 100, true);
        bench.player_round();
        bench.ros_round();
        bench.reset();
        bench.nobody();
        bench.deaf("/r0/odom");
        bench.deaf("/tf");
        bench.crowd();
        echo();
    } catch (const std::exception& fault) {
        fmt::print(stderr, "{}\n", fault.what());
        return 1;
    }
}
