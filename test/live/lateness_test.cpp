// SPDX-License-Identifier: MIT
// Lateness of runs by the clock, with a clock that a test sets: no machine is that slow.
#include "live/lateness.hpp"

#include "live/paced_run.hpp"
#include "test/live/live_command.hpp"
#include "test/live/talk.hpp"
#include "test/live/web_client.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace lateness_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

namespace {

/// Clock of this machine, which is put forward.
class SetClock {
  public:
    Clock::time_point now() const { return Clock::now() + put_forward_; }
    void put_forward(Clock::duration by) { put_forward_ += by; }

  private:
    Clock::duration put_forward_{0};
};

/// Nobody comes, and little is due.
struct Quiet : Front {
    void begin(Session& session, const Scenario&) override { session_ = &session; }
    void opened(Connection, ListenerId) override {}
    std::size_t received(Connection, std::string_view) override { return 0; }
    void closed(Connection) override {}
    Time next() const override { return next_; }
    void tell() override {
        next_ = never;
        clock_->put_forward(takes_);
    }
    Time limit() const override { return limit_; }

    SetClock* clock_ = nullptr;
    Session* session_ = nullptr;
    Time next_ = never, limit_ = never;
    Duration takes_{0};  // by what it tells
};

struct Given {
    std::optional<double> speed = 1;
    Duration away = 1h;         // for which the process is stopped
    Time limit = never;         // of the front
    Time told = never;          // when the front tells something
    Duration telling_takes{0};  // then
};

/// Runs ten hours at most, in which nothing happens.
LiveResult run(const Given& given) {
    Scenario scenario = three_in_a_row();
    scenario.scenario.duration = 10h;
    const TemporaryFolder folder;
    SetClock clock;
    PacedOptions options;
    options.folder = folder.path("out");
    options.speed = given.speed;
    options.most_late = Duration(1min);
    options.late_ends = true;
    options.clock = [&] { return clock.now(); };
    options.fronts.push_back({.entries = {}, .make = [&](Front::Carrier) {
                                  auto front = std::make_unique<Quiet>();
                                  front->clock_ = &clock;
                                  front->limit_ = given.limit;
                                  front->next_ = given.told;
                                  front->takes_ = given.telling_takes;
                                  return front;
                              }});
    options.stop.go_on = [&, looks = 0]() mutable {
        constexpr int stopped_at = 3, ended_at = 20;
        if (looks == stopped_at) clock.put_forward(given.away);
        return ++looks < ended_at;
    };
    return run_paced(scenario, options);
}

}  // namespace

TEST_CASE(
    "lateness: if the idle process of a run was stopped for a while, the run is late by this "
    "duration") {
    for (const double speed : {1.0, 2.0, 0.5}) {
        CAPTURE(speed);
        const LiveResult result = run({.speed = speed});
        CHECK(result.lateness->most > 59min);
        CHECK(result.lateness->most < 61min);
        CHECK(result.lateness->late >= 1);
        CHECK(result.fault.find(" ms behind real time at ") != std::string::npos);
    }
}

TEST_CASE("lateness: a run whose process was not stopped was not late") {
    const LiveResult result = run({.away = 0s});
    CHECK(result.lateness->most < 1min);
    CHECK(result.fault.empty());
}

TEST_CASE("lateness: while a client pauses the time, the run is not late") {
    const LiveResult result = run({.limit = start_of_run});
    CHECK(result.lateness->most < 1min);
    CHECK(result.fault.empty());
}

TEST_CASE(
    "lateness: if the process is stopped, only the time before a client's pause counts as late") {
    const LiveResult result = run({.limit = start_of_run + 10min});
    CHECK(result.lateness->most > 9min);
    CHECK(result.lateness->most < 11min);
}

TEST_CASE("lateness: a run without a set speed is never late") {
    const LiveResult result = run({.speed = std::nullopt});
    CHECK_FALSE(result.lateness);
    CHECK(result.fault.empty());
}

TEST_CASE("lateness: messages that arrive while the run writes output slowly count as late") {
    const LiveResult result = run({.away = 0s, .told = start_of_run + 1ms, .telling_takes = 30min});
    CHECK(result.lateness->most > 29min);
    CHECK_FALSE(result.fault.empty());
}

TEST_CASE("lateness: for the share of late delays, a late poll counts, a poll on time does not") {
    Lateness lateness;
    lateness.add_look(999us);
    CHECK(lateness.most == 999us);
    CHECK(lateness.times == 0);
    lateness.add_look(3ms);
    lateness.add(0ms);
    CHECK(lateness.most == 3ms);
    CHECK(lateness.share() == 0.5);
}

TEST_CASE("live: if the process of a paced run was stopped, the run's summary has its lateness") {
    for (const std::string option : {"--player", "--rosbridge"}) {
        CAPTURE(option);
        const Live live({option, "127.0.0.1:0"}, long_live_row());
        if (option == "--player") {
            LineClient client(live.port());
            CHECK(client.bytes(32).starts_with("Player v."));  // so the clock goes
        } else {
            WebClient(live.port()).ask(R"({"op":"call_service","service":"rosapi/get_time"})");
        }
        constexpr auto stopped_for = 700ms;
        kill(live.process().pid(), SIGSTOP);
        std::this_thread::sleep_for(stopped_for);
        kill(live.process().pid(), SIGCONT);
        std::this_thread::sleep_for(100ms);
        CHECK(live.process().stop().exit == 0);
        const Json summary = Json::parse(content(live.folder.path("out/summary.json")));
        CHECK(summary.at("live").at("late_max_s") > 0.6);
    }
}

}  // namespace lateness_test
