// SPDX-License-Identifier: MIT
#include "live/paced_run.hpp"

#include "live/doors.hpp"
#include "live/loopback.hpp"
#include "live/web_sockets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace rovernet {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t events_a_slice = 256;             // each may reach thousands of robots
constexpr std::chrono::milliseconds longest_wait = 50ms;  // then events go on, Ctrl-C is seen

/// Fronts with their doors around one session, and the clock.
class PacedServer {
  public:
    explicit PacedServer(const PacedOptions& options) : options_(options) {
        for (const FrontDoor& each : options.fronts) open(each);
    }

    /// Serves clients until the run is over.
    void serve(Session& session, const Scenario& scenario) {
        session_ = &session;
        session.step(start_of_run);  // movements may draw where robots begin
        for (const auto& front : fronts_) front->begin(session, scenario);
        started_ = Clock::now();
        while (!is_over() && options_.go_on()) {
            catch_up();
            doors_.wait(spare_time());
        }
    }

    void close() {
        web_.close(300ms);
        doors_.close(300ms);
    }

  private:
    void open(const FrontDoor& door) {
        fronts_.push_back(door.make(door.is_web ? web_carrier() : carrier()));
        for (std::size_t i = 0; i < door.addresses.size(); ++i) listen(*fronts_.back(), door, i);
    }

    Front::Carrier carrier() {
        return {.send = [this](auto to, auto message) { doors_.send(to, message); },
                .close = [this](auto which) { doors_.close(which); }};
    }
    Front::Carrier web_carrier() {
        return {.send = [this](auto to, auto message) { web_.send(to, message); },
                .close = [this](auto which) { web_.close(which); },
                .send_binary = [this](auto to, auto message) { web_.send_binary(to, message); }};
    }

    /// A client's words count from the time that they come in: the run goes on to there first.
    void listen(Front& front, const FrontDoor& door, std::size_t number) {
        const auto entrance = std::make_shared<Entrance>(Entrance{number, 0});
        Doors::Streams streams;
        streams.opened = [this, &front, entrance](auto client) {
            catch_up();
            front.opened(client, *entrance);
        };
        streams.received = [this, &front](auto from, auto bytes) {
            catch_up();
            front.received(from, bytes);
        };
        streams.closed = [this, &front](auto gone) {
            catch_up();
            front.closed(gone);
        };
        const auto& [text, what] = door.addresses[number];
        const std::string address = door.is_web ? web_.listen(text, std::move(streams))
                                                : doors_.listen(text, std::move(streams));
        entrance->port = read_loopback(address).port;
        options_.say(fmt::format("listening on {} ({})", address, what));
        if (!door.is_web) return;
        options_.say(fmt::format("for a page: ws://{}/?token={}", address, web_.token()));
    }

    Time now() const { return session_->network().now(); }

    bool is_over() const {
        return now() >= session_->end() || std::any_of(fronts_.begin(), fronts_.end(),
                                                       [](auto& each) { return each->is_done(); });
    }

    /// Simulated time of the clock.
    Time by_clock() const {
        if (!options_.speed) return never;
        const std::chrono::duration<double> wall = Clock::now() - started_;
        return start_of_run +
               from_seconds(std::min(wall.count() * *options_.speed, seconds(session_->end())));
    }

    /// Time beyond which fronts do not let the run go.
    Time limit() const {
        Time limit = never;
        for (const auto& each : fronts_) limit = std::min(limit, each->limit());
        return limit;
    }

    /// Time up to which the run can go before a front has something to say.
    Time next_stop() const {
        Time stop = std::min(session_->end(), limit());
        for (const auto& each : fronts_) stop = std::min(stop, each->next());
        return stop;
    }

    /// Sets the clock back to the limit of the fronts: the run does not make up for what they held.
    void hold_clock() {
        if (!options_.speed || by_clock() <= limit()) return;
        const std::chrono::duration<double> run_for(seconds(limit()) / *options_.speed);
        started_ = Clock::now() - std::chrono::duration_cast<Clock::duration>(run_for);
    }

    /// Runs on to the time of the clock or to the next stop, for a slice of events at most, and to
    /// the end of all events of one time.
    void catch_up() {
        hold_clock();
        const Time until = std::min(by_clock(), next_stop());
        is_behind_ = until > now() && !session_->advance(until, events_a_slice);
        if (is_behind_) session_->step(now());
        for (const auto& each : fronts_) {
            if (each->next() <= now()) each->tell();
        }
    }

    /// Real time until there is something to do that no client brings.
    std::chrono::milliseconds spare_time() const {
        if (is_behind_) return 0ms;
        const Time stop = next_stop();
        if (stop <= now()) return longest_wait;  // it waits for a client
        if (!options_.speed) return 0ms;
        const std::chrono::duration<double> rest(seconds(stop - by_clock()) / *options_.speed);
        return std::clamp(std::chrono::ceil<std::chrono::milliseconds>(rest), 0ms, longest_wait);
    }

    const PacedOptions& options_;
    Doors doors_;
    WebSockets web_{doors_};
    std::vector<std::unique_ptr<Front>> fronts_;
    Session* session_ = nullptr;
    Clock::time_point started_;
    bool is_behind_ = false;  // the time of the clock
};

}  // namespace

LiveResult run_paced(Scenario scenario, const PacedOptions& options) {
    PacedServer server(options);
    RunResult result =
        run_logged(scenario, options.folder, [&](Session& session, const Fingerprint&) {
            server.serve(session, scenario);
            return true;
        });
    server.close();
    return {std::move(result), std::move(scenario), {}};
}

}  // namespace rovernet
