// SPDX-License-Identifier: MIT
#include "live/lockstep/lockstep.hpp"

#include "experiment/run.hpp"
#include "experiment/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace rovernet {
namespace {

/// Whether a fault of a whole line is that it is no JSON object.
bool is_about_json(std::string_view code) {
    return code == "bad_json" || code == "bad_utf8" || code == "too_deep" || code == "bad_type";
}

}  // namespace

Lockstep::Lockstep(Settings settings, Tell tell) : settings_(settings), tell_(std::move(tell)) {}

void Lockstep::begin(Session& session, const Scenario& scenario,
                     std::function<std::string()> fingerprint) {
    session_ = &session;
    scenario_ = &scenario;
    fingerprint_ = std::move(fingerprint);
    answers_.emplace(session, scenario);
    seed_ = scenario.scenario.seed;
    state_ = State::runs;
    session.step(start_of_run);  // movements may draw where robots begin
    for (Controller& each : controllers_) {
        each.join(session);
        if (has_started_ && each.connection) {
            tell_(*each.connection, answers_->welcome(each.hello));
        }
    }
}

bool Lockstep::receive(Connection from, std::string_view line) {
    if (state_ != State::runs) return true;
    try {
        const Controller* controller = controllers_.of(from);
        Request request = reader_.read(
            line, session_->network(),
            controller ? std::span<const NodeId>(controller->own) : std::span<const NodeId>());
        std::visit([&](auto& each) { handle(from, each); }, request);
    } catch (const RequestError& fault) {
        tell_(from, error_line(fault, reader_.number()));
        return !fault.at().empty() || !is_about_json(fault.code());
    }
    return true;
}

/// Reconnects a lost controller. @return whether the name is that of a lost controller
bool Lockstep::come_back(Connection from, const HelloRequest& hello) {
    Controller* controller = controllers_.named(hello.name);
    if (!controller || controller->connection) return false;
    if (controller->hello.robots != hello.robots || controller->hello.step != hello.step) {
        throw RequestError(
            "taken", "name",
            fmt::format("{} had other robots or another step when it was lost", hello.name));
    }
    controller->connection = from;
    controller->hello = hello;
    tell_(from, answers_->welcome(hello));
    if (!controller->last_state.empty()) tell_(from, controller->last_state);
    return true;
}

void Lockstep::check_claims(const HelloRequest& hello) {
    if (controllers_.named(hello.name)) {
        throw RequestError("taken", "name",
                           fmt::format("there is a controller {} already", hello.name));
    }
    for (std::size_t i = 0; i < hello.robots.size(); ++i) {
        if (!session_->driver(hello.robots[i])) continue;
        throw RequestError("taken", fmt::format("robots[{}]", i),
                           fmt::format("robot {} is another controller's",
                                       session_->network().name(hello.robots[i])));
    }
    const auto measures = [&](NodeId robot) { return !session_->range_finders(robot).empty(); };
    if (hello.observes_scan && std::ranges::none_of(hello.robots, measures)) {
        throw RequestError("bad_value", "observe",
                           "no robot of this hello has a range finder; expected a scan = {...} of "
                           "one in the scenario");
    }
    const bool is_free =
        !has_started_ && std::none_of(controllers_.begin(), controllers_.end(),
                                      [](const auto& each) { return each.hello.seed; });
    if (hello.seed && *hello.seed != seed_ && !is_free) {
        throw RequestError("other_seed", "seed",
                           fmt::format("found {}; the run has {}", *hello.seed, seed_));
    }
}

void Lockstep::handle(Connection from, HelloRequest& hello) {
    if (controllers_.of(from)) {
        throw RequestError("hello_again", "type", "you have said hello already");
    }
    if (hello.name.empty()) hello.name = session_->network().name(hello.robots.front());
    if (come_back(from, hello)) return;
    check_claims(hello);
    if (hello.seed) seed_ = *hello.seed;
    Controller controller(from, hello);
    controller.join(*session_);
    controllers_.add(std::move(controller));
    if (has_started_) {
        tell_(from, answers_->welcome(hello));
    } else {
        start_if_complete();
    }
}

void Lockstep::start_if_complete() {
    if (controllers_.size() < settings_.wait_for) return;
    has_started_ = true;
    if (seed_ != scenario_->scenario.seed) {
        state_ = State::restarts;
        return;
    }
    for (const Controller& each : controllers_) {
        tell_(*each.connection, answers_->welcome(each.hello));
    }
}

/// Controller that sent a request.
Controller& Lockstep::asking(Connection from) {
    Controller* controller = controllers_.of(from);
    if (!controller) throw RequestError("hello_first", "type", "expected a hello first");
    if (!has_started_) {
        throw RequestError("too_early", "",
                           fmt::format("{} of {} controllers are there; wait for the welcome",
                                       controllers_.size(), wanted()));
    }
    if (controller->state != Controller::State::owes) {
        throw RequestError("too_early", "", "the last question is not answered yet");
    }
    return *controller;
}

void Lockstep::handle(Connection from, StepRequest& step) {
    Controller& controller = asking(from);
    if (controller.has_stepped && step.number <= controller.number) {
        throw RequestError(
            "old_number", "n",
            fmt::format("found {}; expected more than {}", step.number, controller.number));
    }
    if (is_done()) {
        throw RequestError("done", "type", "the run is at its end; expected reset or bye");
    }
    for (const auto& [robot, command] : step.commands) {
        const auto* place = std::get_if<PlaceCommand>(&command);
        const std::string why = place ? session_->why_not_at(robot, place->at) : "";
        if (!why.empty())
            throw RequestError("no_room", "do." + session_->network().name(robot) + ".place", why);
    }
    controller.state = Controller::State::waits;
    controller.has_stepped = true;
    controller.number = step.number;
    controller.step_end =
        session_->network().now() +
        std::min(controller.hello.step, session_->end() - session_->network().now());
    controller.step = std::move(step);
}

void Lockstep::handle(Connection from, ResetRequest& reset) {
    Controller& controller = asking(from);
    for (const Controller& each : controllers_) {
        if (each.state != Controller::State::wants_reset || each.reset_seed == reset.seed) continue;
        throw RequestError("other_seed", "seed", "another controller asks for another seed");
    }
    controller.state = Controller::State::wants_reset;
    controller.reset_seed = reset.seed;
}

void Lockstep::handle(Connection from, ByeRequest&) {
    asking(from).state = Controller::State::leaves;
}

/// Removes controllers that sent "bye", in the order of robots. The last removal ends the run.
void Lockstep::remove_leaving() {
    const std::vector<Controller> leaving = controllers_.take_leaving();
    if (leaving.empty()) return;
    for (const Controller& each : leaving) {
        session_->detach(each.client);
        if (each.connection) leaving_.push_back(*each.connection);
    }
    if (controllers_.empty()) return end_run("bye", {});
    Table metrics;
    append_metrics(metrics, session_->network().metrics());
    const std::string line = end_line("bye", fingerprint_(), metrics);
    for (const Connection to : std::exchange(leaving_, {})) tell_(to, line);
}

void Lockstep::lost(Connection connection) {
    std::erase(leaving_, connection);
    Controller* controller = controllers_.of(connection);
    if (!controller || state_ == State::over) return;
    const std::string name = controller->hello.name;
    const bool is_expected = !has_started_ || is_done();
    if (!is_expected && settings_.on_loss == OnLoss::wait) {
        controller->connection.reset();
        return;
    }
    session_->detach(controller->client);
    controllers_.remove(connection);
    if (is_expected && !(has_started_ && controllers_.empty())) return;
    if (!is_expected && settings_.on_loss == OnLoss::stop && !controllers_.empty()) return;
    end_run(is_expected ? "done" : "lost",
            is_expected ? ""
                        : fmt::format("controller {} has gone at {} s without a bye", name,
                                      seconds(session_->network().now())));
}

/// Executes the commands of the current requests, in the order of robots.
void Lockstep::carry_out() {
    std::vector<std::tuple<NodeId, Controller*, const RobotCommand*>> commands;
    for (Controller& each : controllers_) {
        if (!each.step) continue;
        for (const auto& [robot, command] : each.step->commands) {
            commands.emplace_back(robot, &each, &command);
        }
    }
    std::stable_sort(commands.begin(), commands.end(), [](const auto& a, const auto& b) {
        return std::get<NodeId>(a) < std::get<NodeId>(b);
    });
    for (const auto& [robot, controller, command] : commands) {
        const auto uid =
            session_->carry_out(controller->client, robot, *command, controller->number);
        if (uid) controller->sent.push_back({*uid, robot});
    }
    for (Controller& each : controllers_) each.step.reset();
}

void Lockstep::answer(Controller& controller) {
    const std::string_view line = answers_->state(
        controller.hello, controller.number, controller.sent, session_->heard(controller.client));
    controller.state = Controller::State::owes;
    controller.sent.clear();
    if (settings_.on_loss == OnLoss::wait) controller.last_state = line;
    if (controller.connection) tell_(*controller.connection, line);
}

void Lockstep::advance(const std::function<bool()>& go_on) {
    constexpr std::uint64_t events_a_slice = 256;  // each may reach thousands of robots
    remove_leaving();
    if (state_ == State::over) return;
    const Time end = controllers_.next_end();
    if (end == never) {
        seed_ = controllers_.begin()->reset_seed.value_or(seed_);
        state_ = State::restarts;
        return;
    }
    carry_out();
    while (!session_->advance(end, events_a_slice)) {
        if (go_on()) continue;
        session_->step(session_->network().now());  // all of that time, as a replay does
        return end_run("stopped", {});
    }
    for (Controller& each : controllers_) {
        if (each.state == Controller::State::waits && each.step_end == end) answer(each);
    }
}

void Lockstep::end_run(std::string reason, std::string fault) {
    if (state_ == State::over) return;
    state_ = State::over;
    reason_ = std::move(reason);
    fault_ = std::move(fault);
}

void Lockstep::tell_end(std::string_view fingerprint, const Table& metrics) {
    const std::string line = end_line(reason_, fingerprint, metrics);
    for (const Connection to : leaving_) tell_(to, line);
    for (const Controller& each : controllers_) {
        if (each.connection) tell_(*each.connection, line);
    }
}

}  // namespace rovernet
