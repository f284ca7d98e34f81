// SPDX-License-Identifier: MIT
#include "live/paced_run.hpp"

#include "live/carriers/listeners.hpp"
#include "live/carriers/web_sockets.hpp"
#include "live/input_log.hpp"

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
constexpr Duration shortest_wait = 1ms;        // the same, if it must hardly be late

/// Server of a paced run: fronts and their listeners, one session, and the clock.
class PacedServer {
  public:
    explicit PacedServer(const PacedOptions& options) : options_(options) {
        for (const FrontListeners& each : options.fronts) open(each);
    }

    /// Serves clients until the run is over.
    void serve(Session& session, const Scenario& scenario, InputLog& log) {
        session_ = &session;
        session.step(start_of_run);  // movements may draw where robots begin
        for (Open& each : open_) {
            each.front->begin(session, scenario);
            if (each.listeners.open_ports) open_ports(each);
        }
        started_ = options_.clock();
        promised_ = start_of_run;
        while (!is_over() && options_.stop.go_on()) {
            catch_up();
            listeners_.wait(promise(spare_time()));
            log.keep_up();
        }
        look();  // it may have been told to stop while it was late
        session_ = nullptr;
    }

    void close() {
        web_.close(300ms);
        listeners_.close(300ms);
    }

    /// Client statistics for summary.json.
    Table report() const {
        Table counts;
        if (options_.speed) {
            counts.set("speed", *options_.speed);
            counts.set("late_max_s", seconds(lateness_.most));
            counts.set("late_share", lateness_.share());
        }
        for (const Open& each : open_) each.front->report(counts);
        return counts;
    }
    std::optional<Lateness> lateness() const {
        return options_.speed ? std::optional(lateness_) : std::nullopt;
    }
    const std::string& fault() const { return fault_; }

  private:
    /// Front with its listeners.
    struct Open {
        const FrontListeners& listeners;
        std::unique_ptr<Front> front = nullptr;
        FrontListeners::Ports ports = {};
        Time due = never;  // its next(), before the session went on
    };

    void open(const FrontListeners& listeners) {
        Open& opened = open_.emplace_back(Open{listeners});
        opened.front = listeners.make(carrier_for(opened));
        for (std::size_t i = 0; i < listeners.entries.size(); ++i)
            listen(*opened.front, listeners, i);
    }

    Front::Carrier carrier_for(Open& opened) {
        if (opened.listeners.open_ports) {
            return {.send = [&opened](auto to, auto packet) { opened.ports[to]->write(packet); },
                    .close = [](auto) {}};
        }
        if (opened.listeners.is_web) {
            return {.send = [this](auto to, auto message) { web_.send(to, message); },
                    .close = [this](auto which) { web_.close(which); },
                    .send_binary = [this](auto to, auto bytes) { web_.send_binary(to, bytes); }};
        }
        return {.send = [this](auto to, auto message) { listeners_.send(to, message); },
                .close = [this](auto which) { listeners_.close(which); }};
    }

    void listen(Front& front, const FrontListeners& listeners, std::size_t number) {
        const auto listener = std::make_shared<ListenerId>(ListenerId{number, 0});
        Listeners::Streams streams;
        streams.opened = [this, &front, listener](auto client) {
            if (reach_present()) front.opened(client, *listener);
        };
        streams.received = [this, &front](auto from, auto bytes) {
            return reach_present() ? front.received(from, bytes) : 0;
        };
        streams.closed = [this, &front](auto gone) {
            if (reach_present()) front.closed(gone);
        };
        streams.has_rate = options_.speed.has_value();  // else its clients set the pace
        if (listeners.closing_message) streams.closing_message = listeners.closing_message;
        const auto& [wanted, what] = listeners.entries[number];
        const Address address = listeners.is_web ? web_.listen(wanted, std::move(streams))
                                                 : listeners_.listen(wanted, std::move(streams));
        listener->port = address.port;
        options_.say(fmt::format("listening on {} ({})", address.text(), what));
        if (listeners.is_web) options_.say(web_.token_notice(address));
    }

    void open_ports(Open& opened) {
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

    bool is_over() const {
        return now() >= session_->end() || !fault_.empty() ||
               std::any_of(open_.begin(), open_.end(),
                           [](const Open& each) { return each.front->is_done(); });
    }

    /// Simulated time of the clock.
    Time by_clock() const {
        if (!options_.speed) return never;
        const std::chrono::duration<double> wall = options_.clock() - started_;
        return start_of_run +
               from_seconds(std::min(wall.count() * *options_.speed, seconds(session_->end())));
    }

    /// Time beyond which fronts do not let the run go.
    Time limit() const {
        Time limit = never;
        for (const Open& each : open_) limit = std::min(limit, each.front->limit());
        return limit;
    }

    /// Time up to which the run can go before a front has something to say.
    Time next_stop() {
        Time stop = std::min(session_->end(), limit());
        for (Open& each : open_) {
            each.due = each.front->next();
            stop = std::min(stop, each.due);
        }
        return stop;
    }

    /// Sets the clock back to the limit of the fronts, so that the run does not catch up after a
    /// pause.
    void hold_clock() {
        if (!options_.speed || by_clock() <= limit()) return;
        const std::chrono::duration<double> run_for(seconds(limit()) / *options_.speed);
        started_ = options_.clock() - std::chrono::duration_cast<Clock::duration>(run_for);
    }

    /// Polls the clock, and records the delay against the promised time: messages of clients have
    /// waited that long.
    void look() {
        hold_clock();
        if (!options_.speed) return;
        const Time present = by_clock();
        if (present > promised_) {
            const Duration behind = real_time(present - promised_);
            lateness_.add_look(behind);
            judge(behind, present);
        }
        promised_ = present;
    }

    /// Sets the real time within which the clock will be polled again. @return this time
    Duration promise(Duration wait) {
        look();
        if (options_.speed) {
            const double simulated_s = seconds(wait) * *options_.speed;
            const Duration simulated =
                from_seconds(std::min(simulated_s, seconds(session_->end())));
            promised_ = std::min(promised_ + simulated, limit());
        }
        return wait;
    }

    /// Runs up to the time of the clock or the next stop, at most one slice of events, and
    /// completes all events of a time.
    void catch_up() {
        look();
        const Time until = std::min(next_stop(), by_clock());
        is_behind_ = until > now() && !session_->advance(until, events_a_slice);
        if (is_behind_) session_->step(now());
        for (Open& each : open_) {
            if (each.due > now()) continue;
            note_lateness();
            each.front->tell();
        }
    }

    /// Runs up to the current time of the clock, so that a message of a client takes effect at its
    /// arrival.
    /// @return false after the run
    bool reach_present() {
        if (!session_) return false;
        const Time present = options_.speed ? by_clock() : now();
        do {
            catch_up();
        } while (now() < present && now() < next_stop() && options_.stop.go_on());
        return true;
    }

    void note_lateness() {
        if (!options_.speed) return;
        const Duration behind = options_.clock() - started_ - real_time(now() - start_of_run);
        lateness_.add(behind);
        judge(behind, now());
    }

    /// Prints a notice about the delay, or ends the run, if the delay exceeds the limit.
    /// @param at  simulated time
    void judge(Duration behind, Time at) {
        if (!options_.most_late || behind <= *options_.most_late || !fault_.empty()) return;
        const std::string text = fmt::format("{:.1f} ms behind the clock at {:.6f} s",
                                             1e3 * seconds(behind), seconds(at));
        if (options_.late_ends) {
            fault_ = text;
        } else if (!std::exchange(has_told_late_, true)) {
            options_.say(text + ": programs take that for a delay of the radio");
        }
    }

    /// Real time that some simulated time takes.
    Duration real_time(Duration simulated) const {
        return from_seconds(seconds(simulated) / *options_.speed);
    }

    /// Real time until the next event that does not come from a client.
    Duration spare_time() {
        if (is_behind_) return 0ms;
        const Time stop = next_stop();
        const Duration longest = longest_wait_now();
        if (stop <= now()) return longest;  // it waits for a client
        if (!options_.speed) return 0ms;
        return std::clamp<Duration>(real_time(stop - by_clock()), 0ms, longest);
    }

    /// Longest wait, a fraction of the allowed delay, so that a suspension of the process is
    /// noticed.
    Duration longest_wait_now() const {
        constexpr int looks = 4;
        if (!options_.most_late) return longest_wait;
        return std::clamp<Duration>(*options_.most_late / looks, shortest_wait, longest_wait);
    }

    const PacedOptions& options_;
    Listeners listeners_;
    WebSockets web_{listeners_};
    std::list<Open> open_;
    Session* session_ = nullptr;  // while it is served
    Clock::time_point started_;
    Time promised_ = start_of_run;  // time of the clock by which it looks again
    bool is_behind_ = false;        // the time of the clock
    Lateness lateness_;
    bool has_told_late_ = false;
    std::string fault_;
};

}  // namespace

LiveResult run_paced(Scenario scenario, const PacedOptions& options) {
    PacedServer server(options);
    const auto drive = [&](ScenarioRun& run, InputLog& log) {
        server.serve(run.session(), scenario, log);
        if (Table counts = server.report(); !counts.entries.empty()) run.add_part("live", counts);
        return true;
    };
    RunResult result = run_logged(scenario, options.folder, options.stop, drive);
    server.close();
    return {std::move(result), std::move(scenario), server.fault(), server.lateness()};
}

}  // namespace rovernet
