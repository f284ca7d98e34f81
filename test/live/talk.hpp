// SPDX-License-Identifier: MIT
#pragma once

#include "live/lockstep/lockstep.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"
#include "traces/fingerprint.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet::test {

/// A lock-step whose lines are carried by a test.
class Talk {
  public:
    explicit Talk(const Scenario& scenario, Lockstep::Settings settings = {})
        : scenario_(scenario),
          lockstep(settings, [this](auto to, auto line) { told[to].emplace_back(line); }) {
        begin();
    }

    /// Carries a line, and lets time go on where nobody owes a question.
    void say(Lockstep::Connection from, std::string_view line) {
        lockstep.receive(from, line);
        go_on();
    }
    void go_on() {
        while (lockstep.is_due()) {
            lockstep.advance([] { return true; });
        }
        if (lockstep.state() != Lockstep::State::restarts) return;
        scenario_.scenario.seed = lockstep.seed();
        begin();
        go_on();
    }
    /// What is answered to a line.
    std::string ask(Lockstep::Connection from, std::string_view line) {
        told[from].clear();
        say(from, line);
        return told[from].empty() ? std::string() : told[from].back();
    }
    void end() { lockstep.tell_end(fingerprint->text(), {}); }

  private:
    void begin() {
        old_ = std::move(session);
        session = std::make_unique<Session>(scenario_);
        fingerprint = std::make_shared<Fingerprint>();
        session->network().add_sink(fingerprint);
        lockstep.begin(*session, scenario_, [this] { return fingerprint->text(); });
    }

    Scenario scenario_;
    std::unique_ptr<Session> old_;

  public:
    std::map<Lockstep::Connection, std::vector<std::string>> told;
    std::unique_ptr<Session> session;
    std::shared_ptr<Fingerprint> fingerprint;
    Lockstep lockstep;
};

/// Three robots in a row, of which neighbours hear one another; A says something now and then.
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
