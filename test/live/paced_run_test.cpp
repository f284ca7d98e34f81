// SPDX-License-Identifier: MIT
// Runs by the clock, with real sockets and a front that is made for them.
#include "live/paced_run.hpp"

#include "experiment/replay/replay.hpp"
#include "experiment/run.hpp"
#include "live/carriers/address.hpp"
#include "live/carriers/input_rate.hpp"
#include "live/input_replay.hpp"
#include "test/live/line_client.hpp"
#include "test/live/parrot.hpp"
#include "test/live/talk.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/recorded/recorded_reader.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace paced_run_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// A paced run in a thread of its own.
template <class FrontUnderTest>
class Paced {
  public:
    template <class... More>
    explicit Paced(std::optional<double> speed, const Scenario& scenario, More... more) {
        PacedOptions options;
        options.folder = folder_.path("out");
        options.speed = speed;
        options.fronts.push_back(
            {.entries = {{{"127.0.0.1", 0}, "one"}, {{"127.0.0.1", 0}, "another"}},
             .make =
                 [more...](Front::Carrier carrier) {
                     return std::make_unique<FrontUnderTest>(std::move(carrier), more...);
                 },
             .closing_message = [](std::size_t lost) { return fmt::format("lost {}\n", lost); }});
        options.stop.go_on = [this] { return !stopped_; };
        std::promise<void> opened;
        options.say = [&](std::string_view text) {
            said_.emplace_back(text);
            if (said_.size() == 2) opened.set_value();
        };
        run_ = std::async(std::launch::async,
                          [options, scenario] { return run_paced(scenario, options); });
        opened.get_future().wait();
    }
    ~Paced() { stopped_ = true; }

    int port(std::size_t listener = 0) const {
        const std::string words = "listening on 127.0.0.1:";
        return std::stoi(said_[listener].substr(words.size()));
    }
    LiveResult end() { return run_.get(); }
    /// Whether the run ends by itself within five seconds.
    bool ends() const { return run_.wait_for(5s) == std::future_status::ready; }
    void stop() { stopped_ = true; }
    InputReplay replay() const { return replay_inputs(folder_.path("out"), {}); }
    const std::vector<std::string>& said() const { return said_; }
    std::string folder() const { return folder_.path("out"); }

  private:
    TemporaryFolder folder_;
    std::atomic<bool> stopped_ = false;
    std::vector<std::string> said_;
    std::future<LiveResult> run_;
};

/// Time does not go on before a client has said as many bytes as there were tenths of a second.
class Patient : public Parrot {
  public:
    explicit Patient(Carrier carrier, std::size_t flood = 0) : Parrot(std::move(carrier), flood) {}
    std::size_t received(Connection from, std::string_view bytes) override {
        limit_ += 100ms * static_cast<int>(bytes.size());
        return Parrot::received(from, bytes);
    }
    Time limit() const override { return limit_; }
    bool is_done() const override { return limit_ > start_of_run && clients_.empty(); }

  private:
    Time limit_ = start_of_run;
};

/// Asks for so many times that the run is behind the clock; tells a client what time it is [ns]
/// when it comes and when it says something.
class Busy : public Front {
  public:
    explicit Busy(Carrier carrier) : carrier_(std::move(carrier)) {}
    void begin(Session& session, const Scenario&) override { session_ = &session; }
    void opened(Connection client, ListenerId) override { tell_time(client); }
    std::size_t received(Connection from, std::string_view) override {
        tell_time(from);
        return 1;
    }
    void closed(Connection) override {}
    Time next() const override { return session_->network().now() + 50us; }
    void tell() override {}

  private:
    void tell_time(Connection to) {
        const Duration time = session_->network().now() - start_of_run;
        carrier_.send(to, std::to_string(time.count()) + "\n");
    }

    Carrier carrier_;
    Session* session_ = nullptr;
};

/// Asks for given times.
class Timetable : public Front {
  public:
    Timetable(Carrier, std::vector<Time> times, bool is_exact)
        : times_(std::move(times)), is_exact_(is_exact) {}
    void begin(Session& session, const Scenario&) override { session_ = &session; }
    void opened(Connection, ListenerId) override {}
    std::size_t received(Connection, std::string_view) override { return 0; }
    void closed(Connection) override {}
    Time next() const override {
        const auto next = std::upper_bound(times_.begin(), times_.end(), session_->network().now());
        return next == times_.end() ? never : *next;
    }
    void tell() override {}
    bool is_exact() const override { return is_exact_; }

  private:
    std::vector<Time> times_;
    bool is_exact_;
    Session* session_ = nullptr;
};

/// Sends one byte after each of `steps` lines of a time.
void answer(LineClient& client, int steps) {
    client.line();  // the port
    for (int i = 0; i < steps; ++i) {
        client.send_bytes("a");
        client.line();
    }
}

}  // namespace

TEST_CASE(
    "paced run: clients connect, get messages in time, and leave; the run ends with the scenario") {
    Paced<Parrot> paced(2, three_in_a_row());
    CHECK(paced.said()[0].ends_with(" (one)"));
    {
        LineClient first(paced.port());
        CHECK(first.line() == "port " + std::to_string(paced.port()));
        first.send_bytes("abc");
        const int t = std::stoi(first.line());
        CHECK(t % 100 == 0);
        CHECK(std::stoi(first.line()) == t + 100);
    }
    LineClient second(paced.port(1));
    CHECK(second.line() == "port " + std::to_string(paced.port(1)));
    second.send_bytes("xyz");
    std::string last;
    for (std::string line = second.line(); !line.empty(); line = second.line()) last = line;
    CHECK(last == "2000");
    const LiveResult result = paced.end();
    CHECK(result.run.simulated == 2s);
    CHECK(std::filesystem::exists(paced.folder() + "/summary.json"));
    const InputReplay replay = paced.replay();
    CHECK(replay.inputs == 12);
    CHECK(replay.now == result.run.fingerprint);
    CHECK(replay.recorded == replay.now);
}

TEST_CASE("paced run: many simultaneous commands that send messages are replayed in order") {
    // An Aloha station sends at the time at which it is told to, by an event that comes after that.
    Paced<Parrot> paced(4, three_in_a_row("[access]\nmodel = \"aloha\"\n"));
    LineClient client(paced.port());
    client.line();
    for (int i = 0; i < 15; ++i) {
        client.send_bytes("abcdefghij");
        client.line();
    }
    const LiveResult result = paced.end();
    CHECK(result.run.metrics.messages > 100);
    CHECK(paced.replay().now == result.run.fingerprint);
}

TEST_CASE("paced run: commands take effect when they arrive, also in a run behind real time") {
    Scenario scenario = three_in_a_row();
    scenario.scenario.duration = 1h;
    constexpr int speed = 100;
    Paced<Busy> paced(speed, scenario);
    LineClient client(paced.port());
    const Duration came{std::stoll(client.line())};
    constexpr auto waits = 20ms;
    std::this_thread::sleep_for(waits);
    client.send_bytes("a");
    CHECK(Duration{std::stoll(client.line())} >= came + speed * waits);
    paced.stop();
    CHECK(paced.end().lateness->most > 0s);
}

TEST_CASE("paced run: a protocol server changes the recorded trace only if it needs exact times") {
    Scenario scenario = three_in_a_row("[[robot]]\nname = \"D\"\nat = [\"100 m\", \"0 m\"]\n");
    scenario.trace.record = true;
    const TemporaryFolder folder;
    run_scenario(scenario, {.folder = folder.path("out"), .speed = {}});
    const std::string trace = folder.path("out") + "/trace.mcap";
    std::vector<Time> firsts;
    RecordedReader reader(trace);
    while (const Record* record = reader.next()) {
        const auto* received = std::get_if<Received>(record);
        if (received) firsts.push_back(received->receptions[0].time);
    }
    REQUIRE(!firsts.empty());
    const auto bytes = [](const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    for (const bool is_exact : {false, true}) {
        CAPTURE(is_exact);
        Paced<Timetable> paced(std::nullopt, scenario, firsts, is_exact);
        paced.end();
        const std::string paced_trace = paced.folder() + "/trace.mcap";
        CHECK((bytes(paced_trace) == bytes(trace)) == !is_exact);
        CHECK_FALSE(verify_replay(paced_trace, {}).difference);
    }
}

TEST_CASE("paced run: a requested stop ends a run with complete results") {
    Paced<Parrot> paced(1e-3, three_in_a_row());
    LineClient client(paced.port());
    client.line();
    client.send_bytes("a");
    paced.stop();
    const LiveResult result = paced.end();
    CHECK(result.run.simulated < 1s);
    CHECK(paced.replay().now == result.run.fingerprint);
    CHECK(client.line().empty());
}

TEST_CASE(
    "paced run: a run without a set speed is as fast as its clients allow, and can be repeated") {
    std::string fingerprints[2];
    for (std::string& each : fingerprints) {
        Paced<Patient> paced(std::nullopt, three_in_a_row());
        LineClient client(paced.port());
        answer(client, 12);
        client.close();
        const LiveResult result = paced.end();
        CHECK(result.run.simulated <= 1200ms);
        CHECK(result.run.simulated >= 1100ms);
        each = result.run.fingerprint;
    }
    CHECK(fingerprints[0] == fingerprints[1]);
}

TEST_CASE("paced run: after a pause by a client, time continues without catching up") {
    Paced<Patient> paced(2, three_in_a_row());
    LineClient client(paced.port());
    client.line();                        // the port
    std::this_thread::sleep_for(1100ms);  // the scenario would be over
    client.send_bytes(std::string(20, 'a'));
    CHECK(client.line() == "100");
    paced.stop();
    CHECK(paced.end().run.simulated < 2s);
}

TEST_CASE("paced run: a client that does not read is disconnected, and others are served") {
    Scenario scenario = three_in_a_row();
    scenario.scenario.duration = 1h;
    Paced<Patient> paced(std::nullopt, scenario, std::size_t{1} << 20U);
    LineClient deaf(paced.port());
    LineClient reader(paced.port());
    reader.line();  // the port
    std::string last;
    for (int lines = 0; lines < 20; ++lines) {
        // The run waits for this client: the deaf one has a second to read its last message.
        reader.send_bytes("a");
        last = reader.line();
        std::this_thread::sleep_for(100ms);
    }
    CHECK(last.starts_with("2000."));
    reader.close();
    CHECK(paced.ends());  // it has no clients left
    paced.stop();
    paced.end();
    int lines = 0;
    for (std::string line = deaf.line(); !line.empty(); line = deaf.line(), ++lines) {
        // Had it begun to read within a second, it would have been told.
        CHECK((line.ends_with('.') || line.starts_with("lost ") || line.starts_with("port ")));
    }
    CHECK(lines < 15);
}

TEST_CASE(
    "paced run: a client that reads too slowly gets the number of lost messages and is "
    "disconnected") {
    Paced<Patient> paced(std::nullopt, three_in_a_row(), std::size_t{1} << 20U);
    LineClient late(paced.port()), reader(paced.port());
    reader.line();  // the port
    // Ten lines are more than is kept for a client.
    for (int lines = 0; lines < 10; ++lines) {
        reader.send_bytes("a");
        REQUIRE_FALSE(reader.line().empty());
    }
    std::string last;
    for (std::string line = late.line(); !line.empty(); line = late.line()) last = line;
    CHECK(last.starts_with("lost "));
    CHECK(last != "lost 1");
    paced.stop();
    paced.end();
}

TEST_CASE("paced run: input of a client is read at a limited rate") {
    Scenario scenario = three_in_a_row();
    scenario.scenario.duration = 1h;
    Paced<Parrot> paced(1, scenario);
    LineClient client(paced.port());
    client.line();  // the port
    const auto begun = std::chrono::steady_clock::now();
    CHECK(client.send_bytes(std::string(10'000, 'a')));  // each byte is a message
    std::this_thread::sleep_for(100ms);
    CHECK(client.send_bytes("q"));  // it is closed when that is read
    while (!client.line().empty()) {
    }
    CHECK(std::chrono::steady_clock::now() - begun >= 1s);
    paced.stop();
    paced.end();
}

TEST_CASE(
    "paced run: a protocol server may disconnect a client, and may read bytes instead of lines") {
    Paced<Parrot> paced(1, three_in_a_row());
    LineClient client(paced.port());
    client.line();
    std::string bytes = "a";
    bytes += '\0';
    bytes += "q";
    client.send_bytes(bytes);
    while (!client.line().empty()) {
    }
    LineClient other(paced.port());
    CHECK_FALSE(other.line().empty());
    paced.stop();
    paced.end();
    CHECK(paced.replay().inputs == 6);
}

TEST_CASE(
    "input rate: a client may send a burst of one second's input, then 5,000 messages or 16 MiB "
    "per second") {
    const InputRate::Clock::time_point start{1h};
    InputRate rate;
    rate.add(5'000, 0, start);
    CHECK(rate.read_again() == start);
    rate.add(2'500, 0, start);
    CHECK(rate.read_again() == start + 500ms);
    rate.add(1, 0, start + 3s);  // what was not said is not saved up
    rate.add(5'000, 0, start + 3s);
    CHECK(rate.read_again() == start + 3s + 200us);
    InputRate bytes;
    bytes.add(1, std::size_t{32} << 20U, start);
    CHECK(bytes.read_again() > start + 990ms);
    CHECK(bytes.read_again() < start + 1020ms);
}

TEST_CASE("loopback: only addresses of this machine are accepted") {
    CHECK(read_loopback("127.0.0.1:7007").text() == "127.0.0.1:7007");
    CHECK(read_loopback("localhost:0").text() == "127.0.0.1:0");
    CHECK(read_loopback("[::1]:65535").text() == "[::1]:65535");
    CHECK(read_loopback("127.9.9.9:1").port == 1);
    for (const char* bad : {"", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536", "127.0.0.1:-1",
                            "127.0.0.1: 1", "0.0.0.0:1", "[::]:1", "10.0.0.1:1", "host:1", ":1"}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(read_loopback(bad), std::invalid_argument);
    }
    CHECK(Address{"::1", 1}.is_loopback());
    for (const char* open : {"0.0.0.0", "::", "10.0.0.1", "128.0.0.1", "fe80::1"}) {
        CAPTURE(open);
        CHECK_FALSE(Address{open, 1}.is_loopback());
        CHECK(read_host(open) == open);
    }
    CHECK(read_host("[::]") == "::");
    for (const char* bad : {"", "host", "localhost", "1.2.3", "10.0.0.1:80", "[::1"}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(read_host(bad), std::invalid_argument);
    }
}

}  // namespace paced_run_test
