// SPDX-License-Identifier: MIT
#include "live/paced_run.hpp"

#include "experiment/summary.hpp"
#include "live/carriers/listeners.hpp"
#include "live/carriers/web_sockets.hpp"
#include "live/input_log.hpp"
#include "live/run_clock.hpp"
#include "live/served_front.hpp"
#include "traces/fingerprint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <utility>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t events_a_slice = 256;  // each may reach thousands of robots
constexpr Duration longest_wait = 10ms;        // interval of polling the clock and Ctrl-C
constexpr Duration longest_unpaced = 200ms;    // the same, without a clock
constexpr Duration shortest_wait = 1ms;        // the same, if it must hardly be late

/// Server of a paced run: fronts and their listeners, one session, and the clock.
class PacedServer {
  public:
    explicit PacedServer(const PacedOptions& options) : options_(options) {
        for (const FrontListeners& each : options.fronts) open(each);
    }

    /// Prepares the fronts for a run, before its first event. Fronts of a run that begins anew are
    /// new, unless they asked for it.
    void prepare(ScenarioRun& run, const Scenario& scenario) {
        for (ServedFront& each : open_) {
            if (new_seed_ && !each.front->new_seed()) replace(each);
            each.front->prepare(run.session(), scenario);
        }
    }

    /// Serves clients until the run is over, or must begin anew.
    void serve(ScenarioRun& run, const Scenario& scenario, InputLog& log) {
        run_ = &run;
        session_ = &run.session();
        session_->step(start_of_run);  // movements may draw where robots begin
        for (ServedFront& each : open_) begin(each, scenario);
        new_seed_.reset();
        clock_.set(start_of_run);
        promised_ = start_of_run;
        catch_up();
        tell_held();
        while (!is_over() && options_.stop.go_on()) {
            listeners_.wait(promise(spare_time()));
            log.keep_up();
            catch_up();
            tell_held();
        }
        look();  // it may have been told to stop while it was late
        for (const ServedFront& each : open_) {
            if (!new_seed_) new_seed_ = each.front->new_seed();
        }
        session_ = nullptr;
    }

    /// Whether an error ended the run before its clients had begun.
    bool failed_to_begin() const {
        return any([](const Front& f) { return f.failed_to_begin(); });
    }

    /// Seed with which the run must begin anew; none: it is over.
    std::optional<std::uint64_t> new_seed() const { return new_seed_; }

    /// Gives the results to all clients, and serves those that stay.
    void end(const RunResult& result) {
        Table metrics;
        append_metrics(metrics, result.metrics);
        for (const ServedFront& each : open_) each.front->ended(result.fingerprint, metrics);
        stay(result);
    }

    /// Tells all clients that the run has ended without results.
    void end_without_results() {
        for (const ServedFront& each : open_) each.front->ended("", {});
    }

    /// Ends all clients. @return errors that ended the run, and of programs
    std::string close() {
        std::chrono::milliseconds time_to_end = 10s;
        for (const ServedFront& each : open_)
            time_to_end = std::min(time_to_end, each.front->time_to_end());
        constexpr auto soon = 400ms;
        const bool is_hurried = !options_.stop.go_on();
        web_.close(soon, is_hurried ? 2s : time_to_end);
        std::vector<std::string> faults = listeners_.close(soon, is_hurried ? soon : time_to_end);
        if (is_hurried) faults.clear();
        for (const ServedFront& each : open_) faults.insert(faults.begin(), each.front->fault());
        faults.insert(faults.begin(), fault_);
        std::erase(faults, "");
        return fmt::format("{}", fmt::join(faults, "; "));
    }

    /// Client statistics for summary.json.
    Table report() const {
        Table counts;
        if (options_.speed) {
            counts.set("speed", *options_.speed);
            counts.set("late_max_s", seconds(lateness_.most));
            counts.set("late_share", lateness_.share());
        }
        for (const ServedFront& each : open_) each.front->report(counts);
        return counts;
    }
    std::optional<Lateness> lateness() const {
        return options_.speed ? std::optional(lateness_) : std::nullopt;
    }

  private:
    void open(const FrontListeners& listeners) {
        ServedFront& opened = open_.emplace_back(ServedFront{listeners});
        opened.front = listeners.make(carrier_for(opened));
        for (const std::string& each : listeners.programs) {
            const auto program = listeners_.start(each, streams_for(opened, {}));
            if (program) opened.front->started(*program, each);
        }
        for (std::size_t i = 0; i < listeners.entries.size(); ++i) listen(opened, i);
        if (!listeners.unix_path) return;
        listeners_.listen_unix(*listeners.unix_path, streams_for(opened, {}));
        options_.say("listening on " + *listeners.unix_path);
    }

    Front::Carrier carrier_for(ServedFront& opened) {
        if (opened.listeners.open_ports) {
            return {.send = [&opened](auto to, auto packet) { opened.ports[to]->write(packet); },
                    .close = [](auto) {}};
        }
        return {.send =
                    [this](auto to, auto message) {
                        to < WebSockets::first ? listeners_.send(to, message)
                                               : web_.send(to, message);
                    },
                .close =
                    [this](auto which) {
                        which < WebSockets::first ? listeners_.close(which) : web_.close(which);
                    },
                .send_binary = [this](auto to, auto bytes) { web_.send_binary(to, bytes); },
                .fingerprint = [this] { return run_->fingerprint().text(); },
                .unsent = [this](auto to) { return web_.unsent(to); },
                .set_speed = [this](auto speed) { set_speed(speed); }};
    }

    /// Handlers of the connections of a front. A front that was replaced has none.
    Listeners::Streams streams_for(ServedFront& opened, std::shared_ptr<ListenerId> listener) {
        const FrontListeners& wanted = opened.listeners;
        Listeners::Streams streams;
        streams.opened = [this, &opened, listener](auto client) {
            opened.clients.insert(client);
            if (listener && is_served(opened)) opened.front->opened(client, *listener);
        };
        streams.received = [this, &opened](auto from, auto bytes) -> std::size_t {
            if (!is_served(opened) || !opened.clients.contains(from)) return 0;
            return opened.front->received(from, bytes);
        };
        streams.closed = [this, &opened](auto gone) {
            if (is_served(opened) && opened.clients.erase(gone) > 0) opened.front->closed(gone);
        };
        // Without a speed clients set the pace.
        streams.has_rate = wanted.has_rate && options_.speed.has_value();
        if (wanted.closing_message) streams.closing_message = wanted.closing_message;
        streams.line_error = wanted.line_error;
        return streams;
    }

    void listen(ServedFront& opened, std::size_t number) {
        const FrontListeners::Entry& entry = opened.listeners.entries[number];
        const auto listener = std::make_shared<ListenerId>(ListenerId{number, 0});
        Listeners::Streams streams = streams_for(opened, listener);
        const Address address =
            entry.is_web ? web_.listen(entry.at, std::move(streams), opened.listeners.pages)
                         : listeners_.listen(entry.at, std::move(streams));
        listener->port = address.port;
        if (!opened.listeners.pages.empty()) {
            return options_.say("page at " + web_.page_address(address));
        }
        const std::string_view scheme = entry.is_web && entry.what.empty() ? "ws://" : "";
        const std::string what = entry.what.empty() ? "" : fmt::format(" ({})", entry.what);
        options_.say(fmt::format("listening on {}{}{}", scheme, address.text(), what));
        if (entry.is_web) options_.say(web_.token_notice(address));
    }

    /// Replaces a front by a new one, without clients.
    void replace(ServedFront& opened) {
        for (const auto client : std::exchange(opened.clients, {})) {
            client < WebSockets::first ? listeners_.close(client) : web_.close(client);
        }
        opened.front = opened.listeners.make(carrier_for(opened));
    }

    /// Starts a run at a front.
    void begin(ServedFront& opened, const Scenario& scenario) {
        opened.held_at = never;
        opened.front->begin(*session_, scenario);
        if (opened.listeners.open_ports && opened.ports.empty()) open_ports(opened);
    }

    void open_ports(ServedFront& opened) {
        opened.ports = opened.listeners.open_ports(session_->network());
        for (Front::Connection robot = 0; robot < opened.ports.size(); ++robot) {
            PacketPort& port = *opened.ports[robot];
            options_.say("listening on " + port.text());
            listeners_.watch(port.descriptor(), [this, &opened, &port, robot] {
                return port.read([&](std::string_view packet) {
                    if (reach_present()) opened.front->received(robot, packet);
                });
            });
        }
    }

    Time now() const { return session_->network().now(); }

    template <class Holds>
    bool any(Holds holds) const {
        return std::ranges::any_of(open_, [&](const auto& each) { return holds(*each.front); });
    }

    bool is_over() const {
        if (now() >= session_->end() && !any([](const Front& f) { return f.holds_end(); })) {
            return true;
        }
        return !fault_.empty() || any([](const Front& f) { return f.is_done() || f.new_seed(); });
    }

    /// Tells fronts at whose limits the run waits for how long it does.
    void tell_held() {
        const auto time = options_.clock();
        for (ServedFront& each : open_) each.tell_held(now(), time);
    }

    /// Simulated time of the clock.
    Time by_clock() const { return clock_.now(session_->end()); }

    /// Time beyond which fronts do not let the run go.
    Time limit() const {
        Time limit = never;
        for (const ServedFront& each : open_) limit = std::min(limit, each.front->limit());
        return limit;
    }

    /// Time up to which the run can go before a front has something to say.
    Time next_stop() {
        Time stop = exact_stop_ = std::min(session_->end(), limit());
        for (ServedFront& each : open_) {
            each.due = each.front->next();
            stop = std::min(stop, each.due);
            if (each.front->is_exact()) exact_stop_ = std::min(exact_stop_, each.due);
        }
        return stop;
    }

    /// Sets the clock back to the limit of the fronts: the run does not catch up after a pause.
    void hold_clock() {
        if (clock_.paces() && by_clock() > limit()) clock_.set(limit());
    }

    /// Polls the clock, and records the delay against the promised time: messages of clients have
    /// waited that long.
    void look() {
        hold_clock();
        if (!clock_.paces()) return;
        const Time present = by_clock();
        if (present > promised_) {
            const Duration behind = clock_.real_time(present - promised_);
            lateness_.add_look(behind);
            judge(behind, present);
        }
        promised_ = present;
    }

    /// Sets the real time within which the clock will be polled again. @return this time
    Duration promise(Duration wait) {
        look();
        if (clock_.paces())
            promised_ = std::min(promised_ + clock_.simulated(wait, session_->end()), limit());
        return wait;
    }

    /// Runs up to the time of the clock or the next stop, at most one slice of events, and
    /// completes all events of a time.
    void catch_up() {
        look();
        const Time until = std::min(next_stop(), by_clock());
        is_behind_ = until > now() && !session_->advance(until, events_a_slice, exact_stop_);
        if (is_behind_) session_->step(now(), exact_stop_);
        for (ServedFront& each : open_) {
            if (each.due > now()) continue;
            note_lateness();
            each.front->tell();
        }
    }

    /// Runs up to the current time of the clock, at which a client's message takes effect.
    /// @return false after the run
    bool reach_present() {
        if (!session_) return false;
        const Time present = clock_.paces() ? by_clock() : now();
        do {
            catch_up();
        } while (now() < present && now() < next_stop() && options_.stop.go_on());
        return true;
    }

    /// Runs up to the current time of the clock. @return whether the front has clients to serve
    bool is_served(const ServedFront& opened) { return reach_present() || opened.front->stays(); }

    /// Serves the clients of fronts that stay after the run, until the user stops the program.
    void stay(const RunResult& result) {
        const auto stays = [](const Front& f) { return f.stays(); };
        if (!options_.stop.go_on() || !any(stays)) return;
        options_.finished(result);
        while (options_.stop.go_on() && any(stays)) {
            for (const ServedFront& each : open_) each.front->held({});
            listeners_.wait(longest_wait);
        }
    }

    /// Changes the speed of the run from now on.
    void set_speed(std::optional<double> speed) {
        clock_.set_speed(speed, now());
        promised_ = now();
    }

    void note_lateness() {
        if (!clock_.paces()) return;
        const Duration behind = clock_.since(now());
        lateness_.add(behind);
        judge(behind, now());
    }

    /// Prints a notice about the delay, or ends the run, if the delay exceeds the limit.
    /// @param at  simulated time
    void judge(Duration behind, Time at) {
        if (!options_.most_late || behind <= *options_.most_late || !fault_.empty()) return;
        const auto text = fmt::format("the run is {:.1f} ms behind real time at t = {:.6f} s",
                                      1e3 * seconds(behind), seconds(at));
        if (options_.late_ends) {
            fault_ = text;
        } else if (!std::exchange(has_told_late_, true)) {
            options_.say(text + ", so programs receive their messages with this delay");
        }
    }

    /// Real time until the next event that does not come from a client.
    Duration spare_time() {
        if (is_behind_) return 0ms;
        const Time stop = next_stop();
        const Duration longest = longest_wait_now();
        if (stop <= now()) return longest;  // it waits for a client
        if (!clock_.paces()) return 0ms;
        return std::clamp<Duration>(clock_.real_time(stop - by_clock()), 0ms, longest);
    }

    /// Longest wait, a fraction of the allowed delay, so that a suspension of the process is
    /// noticed.
    Duration longest_wait_now() const {
        constexpr int looks = 4;
        if (!clock_.paces()) return longest_unpaced;
        if (!options_.most_late) return longest_wait;
        return std::clamp<Duration>(*options_.most_late / looks, shortest_wait, longest_wait);
    }

    const PacedOptions& options_;
    RunClock clock_{options_.clock, options_.speed};
    Listeners listeners_;
    WebSockets web_{listeners_};
    std::list<ServedFront> open_;
    ScenarioRun* run_ = nullptr;  // the last that was served
    Session* session_ = nullptr;  // while it is served
    std::optional<std::uint64_t> new_seed_;
    Time promised_ = start_of_run;  // time of the clock by which it looks again
    Time exact_stop_ = never;       // next time at which the run must stop exactly
    bool is_behind_ = false;        // the time of the clock
    Lateness lateness_;
    bool has_told_late_ = false;
    std::string fault_;
};

}  // namespace

LiveResult run_paced(Scenario scenario, const PacedOptions& options) {
    PacedServer server(options);
    for (;;) {
        const auto drive = [&](ScenarioRun& run, InputLog& log) {
            server.serve(run, scenario, log);
            Table counts = server.report();
            if (!counts.entries.empty()) run.add_part("live", std::move(counts));
            return !server.new_seed() && !server.failed_to_begin();
        };
        try {
            RunResult result = run_logged(
                scenario, options.folder, options.stop,
                [&](ScenarioRun& run) { server.prepare(run, scenario); }, drive);
            server.end(result);
            return {std::move(result), std::move(scenario), server.close(), server.lateness()};
        } catch (const Interrupted&) {
            if (server.failed_to_begin()) {
                server.end_without_results();
                throw RunError(server.close());
            }
            if (!server.new_seed() || !options.stop.go_on()) throw;
        }
        scenario.scenario.seed = *server.new_seed();
    }
}

}  // namespace rovernet
