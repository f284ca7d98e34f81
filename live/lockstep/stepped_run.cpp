// SPDX-License-Identifier: MIT
#include "live/lockstep/stepped_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace rovernet {
SteppedRun::SteppedRun(Scenario scenario, Settings settings)
    : scenario_(std::move(scenario)), settings_(std::move(settings)) {
    if (settings_.step < shortest_step) {
        throw std::invalid_argument(
            fmt::format("a step must be 1 us or more, got {} s", seconds(settings_.step)));
    }
    begin();
}

SteppedRun::~SteppedRun() = default;

void SteppedRun::begin() {
    run_ = std::make_unique<ScenarioRun>(scenario_, &kept_);
    Session& session = run_->session();
    Network& network = session.network();
    if (settings_.folder) {
        run_->write_to(*settings_.folder);
        log_.emplace(*settings_.folder, scenario_);
        session.on_input([this, &network](const Input& input) { log_->add(input, network); });
    }
    if (settings_.prepare) settings_.prepare(network);
    robots_.clear();
    if (settings_.robots) {
        for (const std::string& each : *settings_.robots) {
            robots_.push_back(robot_named(network, each));
        }
    } else {
        for (NodeId n{0}; n.index() < network.size(); ++n.value) robots_.push_back(n);
    }
    controllers_.clear();
    controllers_.add(Controller(
        std::nullopt, {.name = settings_.client, .robots = robots_, .step = settings_.step}));
    controller().join(session);  // before the first event, so that frames of its time have levels
    session.step(start_of_run);  // movements may draw where robots begin
    movements_.assign(robots_.size(), std::nullopt);
    messages_.clear();
    poses_.resize(3 * robots_.size());
    request_.number = 0;
    look();
}

void SteppedRun::reset(std::optional<std::uint64_t> seed) {
    if (log_) log_->discard();
    log_.reset();
    run_.reset();
    if (seed) scenario_.scenario.seed = *seed;
    try {
        begin();
    } catch (...) {
        log_.reset();
        run_.reset();
        throw;
    }
}

ScenarioRun& SteppedRun::run() const {
    if (run_) return *run_;
    throw RunError("the run is over; expected reset() first");
}

void SteppedRun::command(std::size_t row, RobotCommand command) {
    check(command, name(row));
    const std::string why = session().why_not(robots_[row], command);
    if (!why.empty()) throw std::invalid_argument(fmt::format("{}: {}", name_of(command), why));
    if (std::holds_alternative<SendCommand>(command)) {
        messages_.emplace_back(robots_[row], std::move(command));
    } else {
        movements_[row] = std::move(command);
    }
}

void SteppedRun::drive(std::span<const double> velocities, std::optional<Duration> timeout) {
    if (velocities.size() != 2 * robots_.size()) {
        throw std::invalid_argument(
            fmt::format("expected an array of velocities with the shape ({}, 2)", robots_.size()));
    }
    const auto is_left = [&](std::size_t row) {
        return std::isnan(velocities[2 * row]) && std::isnan(velocities[2 * row + 1]);
    };
    const auto drive_of = [&](std::size_t row) {
        return DriveCommand{{velocities[2 * row]}, {velocities[2 * row + 1]}, timeout};
    };
    const auto is_fine = [](const DriveCommand& drive) {
        return drive_speeds.contains(drive.speed.value) &&
               drive_turns.contains(drive.turn_rate.value);
    };
    for (std::size_t row = 0; row < robots_.size(); ++row) {
        // The name is made only for an error.
        if (!is_left(row) && (timeout || !is_fine(drive_of(row)))) check(drive_of(row), name(row));
    }
    for (std::size_t row = 0; row < robots_.size(); ++row) {
        if (!is_left(row)) movements_[row] = drive_of(row);
    }
}

/// Makes a request of the commands since the last step. What a sink commands meanwhile belongs to
/// the next one.
void SteppedRun::fill_request() {
    ++request_.number;
    request_.commands.clear();
    for (std::size_t row = 0; row < robots_.size(); ++row) {
        if (!movements_[row]) continue;
        request_.commands.emplace_back(robots_[row], std::move(*movements_[row]));
        movements_[row].reset();
    }
    std::move(messages_.begin(), messages_.end(), std::back_inserter(request_.commands));
    messages_.clear();
}

bool SteppedRun::step(std::uint64_t most_events, const std::function<bool()>& go_on) {
    Session& session = run().session();
    if (is_done()) throw RunError("the run is at its end; expected reset() or finish()");
    fill_request();
    controller().ask(session, request_);
    controllers_.carry_out(session);
    const Time end = controllers_.next_end();
    bool is_whole = false;
    do {
        is_whole = session.advance(end, most_events);
    } while (!is_whole && go_on());
    if (log_) log_->keep_up();
    look();
    return is_whole;
}

/// Notes where the robots are.
void SteppedRun::look() {
    const Network& network = session().network();
    double* pose = poses_.data();
    for (const NodeId robot : robots_) {
        const Vec3 at = network.position(robot);
        *pose++ = at.x;
        *pose++ = at.y;
        *pose++ = network.heading(robot).value;
    }
}

RunResult SteppedRun::finish() {
    session().detach(controller().client);
    session().step(session().network().now());  // all of that time, as a replay does
    RunResult result = run().finish();
    if (log_) log_->finish(result.simulated, result.fingerprint);
    log_.reset();
    run_.reset();
    return result;
}

}  // namespace rovernet
