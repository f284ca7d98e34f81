// SPDX-License-Identifier: MIT
#pragma once

#include "live/lockstep/lockstep.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/live/run_front.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rovernet::test {

/// Lock-step run without sockets: the test passes the lines to it and back.
class Talk {
  public:
    explicit Talk(const Scenario& scenario, Lockstep::Settings settings = {})
        : scenario_(scenario),
          lockstep(std::move(settings),
                   {.send = [this](auto to, auto line) { told[to].emplace_back(line); },
                    .close = [](auto) {},
                    .fingerprint = [this] { return fingerprint->text(); }}) {
        begin();
    }

    /// Passes a line to the lock-step run, and advances the time while the run waits for no
    /// controller.
    void say(Lockstep::Connection from, std::string_view line) {
        lockstep.received(from, line);
        go_on();
    }
    void go_on() {
        run_front(*session, lockstep, session->end());
        if (!lockstep.new_seed()) return;
        scenario_.scenario.seed = *lockstep.new_seed();
        begin();
        go_on();
    }
    /// Answer to a line.
    std::string ask(Lockstep::Connection from, std::string_view line) {
        told[from].clear();
        say(from, line);
        return told[from].empty() ? std::string() : told[from].back();
    }
    void end() { lockstep.ended(fingerprint->text(), {}); }

  private:
    void begin() {
        old_ = std::move(session);
        session = std::make_unique<Session>(scenario_);
        fingerprint = std::make_shared<Fingerprint>();
        session->network().add_sink(fingerprint);
        session->step(start_of_run);
        lockstep.begin(*session, scenario_);
    }

    Scenario scenario_;
    std::unique_ptr<Session> old_;

  public:
    std::map<Lockstep::Connection, std::vector<std::string>> told;
    std::unique_ptr<Session> session;
    std::shared_ptr<Fingerprint> fingerprint;
    Lockstep lockstep;
};

/// Scenario of three robots in a row. Only neighbours hear each other, and A sends messages at
/// times.
inline Scenario three_in_a_row(const std::string& more = {}) {
    const TemporaryFolder folder;
    return load_scenario(folder.write("row.toml", R"([scenario]
name = "row"
duration = "2 s"
[propagation]
model = "friis"
[radio]
sensitivity = "-70 dBm"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["150 m", "0 m"]
[[robot]]
name = "C"
at = ["300 m", "0 m"]
[[traffic]]
from = "A"
payload = "tick"
start = "0.5 s"
every = "1 s"
)" + more),
                         {});
}

}  // namespace rovernet::test
