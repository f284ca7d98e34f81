// SPDX-License-Identifier: MIT
#include "live/lockstep/live_run.hpp"

#include "experiment/summary.hpp"
#include "live/carriers/listeners.hpp"
#include "live/carriers/web_sockets.hpp"
#include "live/input_log.hpp"
#include "traces/fingerprint.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// Transport of the lines of a lock-step run by listeners.
class LiveServer {
  public:
    explicit LiveServer(const LiveOptions& options)
        : options_(options),
          lockstep_(options.lockstep, [this](auto to, auto line) { send(to, line); }),
          listeners_(
              {.line = [this](auto from, auto line) { return lockstep_.receive(from, line); },
               .refuse = [this](auto to, const auto& why) { lockstep_.refuse(to, why); },
               .closed = [this](auto gone) { lockstep_.lost(gone); }}) {}

    Lockstep& lockstep() { return lockstep_; }

    void open() {
        for (const std::string& command : options_.controllers) listeners_.start(command);
        if (options_.listen)
            options_.say("listening on " + listeners_.listen(*options_.listen).text());
        if (options_.web) listen_web(*options_.web);
        if (options_.unix_path) {
            listeners_.listen_unix(*options_.unix_path);
            options_.say("listening on " + *options_.unix_path);
        }
    }

    /// Serves controllers until the run ends or is reset.
    void serve(InputLog& log) {
        asked_ = Clock::now();
        while (lockstep_.state() == Lockstep::State::runs) {
            if (!options_.stop.go_on()) return lockstep_.end_run("stopped", {});
            if (lockstep_.is_due()) {
                lockstep_.advance(options_.stop.go_on);
                asked_ = Clock::now();
                continue;
            }
            tell_missing();
            listeners_.wait(200ms);
            check_request_timeout();
            check_missing_controllers();
            log.keep_up();
        }
    }

    /// Ends the run and all connections. @return errors
    std::string close(const RunResult& run) {
        Table metrics;
        append_metrics(metrics, run.metrics);
        lockstep_.tell_end(run.fingerprint, metrics);
        web_.close(400ms);
        const bool is_hurried = !options_.stop.go_on();
        const auto failed = listeners_.close(is_hurried ? 400ms : 10s);
        std::string fault = lockstep_.fault();
        if (is_hurried) return fault;
        for (const std::string& each : failed) fault += (fault.empty() ? "" : "; ") + each;
        return fault;
    }

  private:
    /// A line goes to a WebSocket as a message.
    void send(Lockstep::Connection to, std::string_view line) {
        to < WebSockets::first ? listeners_.send(to, line) : web_.send(to, line);
    }
    void listen_web(const Address& address) {
        Listeners::Streams users;
        users.received = [this](auto from, auto line) {
            lockstep_.receive(from, line);
            return std::size_t{1};
        };
        users.closed = [this](auto gone) { lockstep_.lost(gone); };
        users.has_rate = false;  // each message is answered first
        const Address own = web_.listen(address, std::move(users));
        options_.say("listening on ws://" + own.text());
        options_.say(web_.token_notice(own));
    }

    void tell_missing() {
        const std::size_t present = lockstep_.controllers().size();
        if (lockstep_.has_started() || told_present_ == present) return;
        told_present_ = present;
        options_.say(fmt::format("waiting for controllers: {} of {} {} there", present,
                                 lockstep_.wanted(), present == 1 ? "is" : "are"));
    }

    void check_request_timeout() {
        if (!options_.patience || !lockstep_.has_started()) return;
        if (Clock::now() - asked_ < *options_.patience) return;
        const std::chrono::duration<double> patience = *options_.patience;
        lockstep_.end_run(
            "patience",
            fmt::format("no question within {:g} s from controller {}", patience.count(),
                        fmt::join(lockstep_.controllers().owing(), ", ")));
    }

    /// Ends a run that cannot start, since a program has ended before its "hello".
    void check_missing_controllers() {
        if (lockstep_.has_started() || listeners_.listens() || web_.listens()) return;
        if (listeners_.connections() < lockstep_.wanted()) {
            lockstep_.end_run("lost", "a controller has ended before its hello");
        }
    }

    const LiveOptions& options_;
    Lockstep lockstep_;
    Listeners listeners_;
    WebSockets web_{listeners_};
    Clock::time_point asked_;
    std::optional<std::size_t> told_present_;
};

/// One run, from its start to its end or to a reset. @return nothing if it begins anew
std::optional<RunResult> run_once(const Scenario& scenario, const LiveOptions& options,
                                  LiveServer& server) {
    const auto drive = [&](ScenarioRun& run, InputLog& log) {
        server.lockstep().begin(run.session(), scenario, [&] { return run.fingerprint().text(); });
        server.serve(log);
        return server.lockstep().state() == Lockstep::State::over;
    };
    try {
        return run_logged(scenario, options.folder, options.stop, drive);
    } catch (const Interrupted&) {
        const bool restarts = server.lockstep().state() == Lockstep::State::restarts;
        if (!restarts || !options.stop.go_on()) throw;
        return std::nullopt;
    }
}

}  // namespace

LiveResult run_live(Scenario scenario, const LiveOptions& options) {
    LiveServer server(options);
    server.open();
    for (;;) {
        auto result = run_once(scenario, options, server);
        if (result) {
            std::string fault = server.close(*result);
            return {std::move(*result), std::move(scenario), std::move(fault)};
        }
        scenario.scenario.seed = server.lockstep().seed();
    }
}

}  // namespace rovernet
