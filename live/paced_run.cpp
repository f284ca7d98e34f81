// SPDX-License-Identifier: MIT
#include "live/paced_run.hpp"

#include "live/carriers/address.hpp"
#include "live/carriers/listeners.hpp"
#include "live/input_log.hpp"
#include "live/carriers/web_sockets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <list>
#include <utility>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t events_a_slice = 256;  // each may reach thousands of robots
constexpr Duration longest_wait = 10ms;        // then it looks at the clock; Ctrl-C is seen
constexpr Duration shortest_wait = 1ms;        // the same, if it must hardly be late

/// Fronts with their doors around one session, and the clock.
class PacedServer {
  public:
    explicit PacedServer(const PacedOptions& options) : options_(options) {
        for (const FrontDoor& each : options.fronts) open(each);
    }

    /// Serves clients until the run is over.
    void serve(Session& session, const Scenario& scenario, InputLog& log) {
        session_ = &session;
        session.step(start_of_run);  // movements may draw where robots begin
        for (Open& each : open_) {
            each.front->begin(session, scenario);
            if (each.door.open_ports) open_ports(each);
        }
        started_ = options_.clock();
        promised_ = start_of_run;
        while (!is_over() && options_.stop.go_on()) {
            catch_up();
            doors_.wait(promise(spare_time()));
            log.keep_up();
        }
        look();  // it may have been told to stop while it was late
        session_ = nullptr;
    }

    void close() {
        web_.close(300ms);
        doors_.close(300ms);
    }

    /// What summary.json tells of the run's clients.
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
    /// A front behind its door.
    struct Open {
        const FrontDoor& door;
        std::unique_ptr<Front> front = nullptr;
        FrontDoor::Ports ports = {};
        Time due = never;  // its next(), before the session went on
    };

    void open(const FrontDoor& door) {
        Open& opened = open_.emplace_back(Open{door});
        opened.front = door.make(carrier_for(opened));
        for (std::size_t i = 0; i < door.entries.size(); ++i) listen(*opened.front, door, i);
    }

    Front::Carrier carrier_for(Open& opened) {
        if (opened.door.open_ports) {
            return {.send = [&opened](auto to, auto packet) { opened.ports[to]->write(packet); },
                    .close = [](auto) {}};
        }
        if (opened.door.is_web) {
            return {.send = [this](auto to, auto message) { web_.send(to, message); },
                    .close = [this](auto which) { web_.close(which); },
                    .send_binary = [this](auto to, auto bytes) { web_.send_binary(to, bytes); }};
        }
        return {.send = [this](auto to, auto message) { doors_.send(to, message); },
                .close = [this](auto which) { doors_.close(which); }};
    }

    void listen(Front& front, const FrontDoor& door, std::size_t number) {
        const auto entrance = std::make_shared<Entrance>(Entrance{number, 0});
        Doors::Streams streams;
        streams.opened = [this, &front, entrance](auto client) {
            if (reach_present()) front.opened(client, *entrance);
        };
        streams.received = [this, &front](auto from, auto bytes) {
            return reach_present() ? front.received(from, bytes) : 0;
        };
        streams.closed = [this, &front](auto gone) {
            if (reach_present()) front.closed(gone);
        };
        streams.has_rate = options_.speed.has_value();  // else its clients set the pace
        if (door.farewell) streams.farewell = door.farewell;
        const auto& [wanted, what] = door.entries[number];
        const Address address = door.is_web ? web_.listen(wanted, std::move(streams))
                                            : doors_.listen(wanted, std::move(streams));
        entrance->port = address.port;
        options_.say(fmt::format("listening on {} ({})", address.text(), what));
        if (door.is_web) options_.say(web_.invitation(address));
    }

    void open_ports(Open& opened) {
        opened.ports = opened.door.open_ports(session_->network());
        for (Front::Connection robot = 0; robot < opened.ports.size(); ++robot) {
            PacketPort& port = *opened.ports[robot];
            options_.say("listening on " + port.text());
            doors_.watch(port.descriptor(), [this, &opened, &port, robot] {
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

    /// Sets the clock back to the limit of the fronts: the run does not make up for what they held.
    void hold_clock() {
        if (!options_.speed || by_clock() <= limit()) return;
        const std::chrono::duration<double> run_for(seconds(limit()) / *options_.speed);
        started_ = options_.clock() - std::chrono::duration_cast<Clock::duration>(run_for);
    }

    /// Looks at the clock, and notes by how much it comes later than promised: what clients said
    /// meanwhile has waited, whether or not anything was due.
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

    /// Promises to look again within some real time. @return it
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

    /// Runs on to the time of the clock or to the next stop, for a slice of events at most, and to
    /// the end of all events of one time.
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

    /// Runs on to the time that the clock has now: a client's words count from when they come in.
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

    /// Says that it is late, or ends the run, if it is later than it may be.
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

    /// Real time until there is something to do that no client brings.
    Duration spare_time() {
        if (is_behind_) return 0ms;
        const Time stop = next_stop();
        const Duration longest = longest_wait_now();
        if (stop <= now()) return longest;  // it waits for a client
        if (!options_.speed) return 0ms;
        return std::clamp<Duration>(real_time(stop - by_clock()), 0ms, longest);
    }

    /// Longest wait, after which it would have noticed that it had been away: a part of what it may
    /// be late.
    Duration longest_wait_now() const {
        constexpr int looks = 4;
        if (!options_.most_late) return longest_wait;
        return std::clamp<Duration>(*options_.most_late / looks, shortest_wait, longest_wait);
    }

    const PacedOptions& options_;
    Doors doors_;
    WebSockets web_{doors_};
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
