// SPDX-License-Identifier: MIT
#include "live/lockstep/lockstep.hpp"

#include "experiment/run.hpp"
#include "experiment/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

namespace rovernet {
namespace {

/// Whether a fault is that the line is no JSON object.
bool is_about_json(const RequestError& fault) {
    const std::string_view code = fault.code();
    return fault.at().empty() &&
           (code == "bad_json" || code == "bad_utf8" || code == "too_deep" || code == "bad_type");
}

}  // namespace

Lockstep::Lockstep(Settings settings, Carrier carrier)
    : settings_(std::move(settings)), carrier_(std::move(carrier)) {}

void Lockstep::begin(Session& session, const Scenario& scenario) {
    session_ = &session;
    scenario_ = &scenario;
    answers_.emplace(session, scenario);
    seed_ = scenario.scenario.seed;
    new_seed_.reset();
    for (Controller& each : controllers_) {
        each.join(session);
        if (has_started_ && each.connection) {
            carrier_.send(*each.connection, answers_->welcome(each.hello));
        }
    }
    catch_up();
}

void Lockstep::started(Connection program, const std::string& command) {
    silent_.emplace(program, command);
}

std::size_t Lockstep::received(Connection from, std::string_view line) {
    if (!goes_on()) return 1;
    if (step_end_ && (controllers_.of(from) || is_object(line))) {
        after_step_.emplace_back(
            [this, from, text = std::string(line)] { handle_line(from, text); });
        return 1;
    }
    const bool is_object = handle_line(from, line);
    go_on();
    return is_object ? 1 : 0;
}

bool Lockstep::is_object(std::string_view line) {
    try {
        reader_.read(line, session_->network(), {});
    } catch (const RequestError& fault) {
        return !is_about_json(fault);
    }
    return true;
}

/// Handles a line between two steps. @return whether it is a JSON object
bool Lockstep::handle_line(Connection from, std::string_view line) {
    try {
        const Controller* controller = controllers_.of(from);
        Request request = reader_.read(
            line, session_->network(),
            controller ? std::span<const NodeId>(controller->own) : std::span<const NodeId>());
        std::visit([&](auto& each) { handle(from, each); }, request);
    } catch (const RequestError& fault) {
        carrier_.send(from, error_line(fault, reader_.number()));
        return !is_about_json(fault);
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
            fmt::format("expected the robots and the step that controller {} had before it "
                        "disconnected, or a controller with a different name",
                        hello.name));
    }
    controller->connection = from;
    controller->hello = hello;
    carrier_.send(from, answers_->welcome(hello));
    if (!controller->last_state.empty()) carrier_.send(from, controller->last_state);
    return true;
}

void Lockstep::check_claims(const HelloRequest& hello) {
    if (controllers_.named(hello.name)) {
        throw RequestError("taken", "name",
                           fmt::format("there is already a controller named {}; expected a "
                                       "different name",
                                       hello.name));
    }
    for (std::size_t i = 0; i < hello.robots.size(); ++i) {
        if (!session_->driver(hello.robots[i])) continue;
        throw RequestError("taken", fmt::format("robots[{}]", i),
                           fmt::format("robot {} belongs to a different controller",
                                       session_->network().name(hello.robots[i])));
    }
    const auto measures = [&](NodeId robot) { return !session_->range_finders(robot).empty(); };
    if (hello.observes_scan && std::ranges::none_of(hello.robots, measures)) {
        throw RequestError("bad_value", "observe",
                           "no robot of this message has a range finder; expected a robot with "
                           "scan = {...} in the scenario");
    }
    const bool is_free =
        !has_started_ && std::none_of(controllers_.begin(), controllers_.end(),
                                      [](const auto& each) { return each.hello.seed; });
    if (hello.seed && *hello.seed != seed_ && !is_free) {
        throw RequestError(
            "other_seed", "seed",
            fmt::format("found the seed {}, but the run already has the seed {}; expected the seed "
                        "of the run, or no key \"seed\"",
                        *hello.seed, seed_));
    }
}

void Lockstep::handle(Connection from, HelloRequest& hello) {
    if (controllers_.of(from)) {
        throw RequestError("hello_again", "type",
                           "you have already sent a message of type \"hello\"");
    }
    if (hello.name.empty()) hello.name = session_->network().name(hello.robots.front());
    if (!come_back(from, hello)) join(from, hello);
    silent_.erase(from);
}

/// Makes a program that has said hello a controller.
void Lockstep::join(Connection from, const HelloRequest& hello) {
    check_claims(hello);
    if (hello.seed) seed_ = *hello.seed;
    Controller controller(from, hello);
    controller.join(*session_);
    controllers_.add(std::move(controller));
    if (has_started_) {
        carrier_.send(from, answers_->welcome(hello));
    } else {
        start_if_complete();
    }
}

void Lockstep::start_if_complete() {
    if (controllers_.size() < settings_.wait_for) return;
    has_started_ = true;
    if (seed_ != scenario_->scenario.seed) {
        new_seed_ = seed_;
        return;
    }
    for (const Controller& each : controllers_) {
        carrier_.send(*each.connection, answers_->welcome(each.hello));
    }
}

/// Controller that sent a request.
Controller& Lockstep::asking(Connection from) {
    Controller* controller = controllers_.of(from);
    if (!controller)
        throw RequestError("hello_first", "type", "expected a message of type \"hello\" first");
    if (!has_started_) {
        throw RequestError(
            "too_early", "",
            fmt::format(
                "{} of {} controllers are connected; wait for the message of type \"welcome\"",
                controllers_.size(), settings_.wait_for));
    }
    if (controller->state != Controller::State::owes) {
        throw RequestError("too_early", "",
                           "the previous request is not answered yet; wait for its answer");
    }
    return *controller;
}

void Lockstep::handle(Connection from, StepRequest& step) {
    Controller& controller = asking(from);
    if (controller.has_stepped && step.number <= controller.step.number) {
        throw RequestError(
            "old_number", "n",
            fmt::format("found the number {}; expected a number larger than {}, the number of the "
                        "previous step",
                        step.number, controller.step.number));
    }
    if (is_at_end()) {
        throw RequestError("done", "type", "the run is at its end; expected \"reset\" or \"bye\"");
    }
    for (const auto& [robot, command] : step.commands) {
        const std::string why = session_->why_not(robot, command);
        if (why.empty()) continue;
        throw RequestError(
            "no_room", fmt::format("do.{}.{}", session_->network().name(robot), name_of(command)),
            why);
    }
    controller.ask(*session_, step);
}

void Lockstep::handle(Connection from, ResetRequest& reset) {
    Controller& controller = asking(from);
    for (const Controller& each : controllers_) {
        if (each.state != Controller::State::wants_reset || each.reset_seed == reset.seed) continue;
        throw RequestError("other_seed", "seed",
                           "another controller has requested a reset with a different seed; "
                           "expected the same seed from all controllers");
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
    const std::string line = end_line("bye", carrier_.fingerprint(), metrics);
    for (const Connection to : std::exchange(leaving_, {})) carrier_.send(to, line);
}

void Lockstep::closed(Connection gone) {
    if (settings_.programs) --*settings_.programs;
    silent_.erase(gone);
    if (step_end_) {
        after_step_.emplace_back([this, gone] { lose(gone); });
        return;
    }
    lose(gone);
    go_on();
}

void Lockstep::lose(Connection gone) {
    std::erase(leaving_, gone);
    Controller* controller = controllers_.of(gone);
    if (!controller || !goes_on()) return;
    const std::string name = controller->hello.name;
    const bool is_expected = !has_started_ || is_at_end();
    if (!is_expected && settings_.on_loss == OnLoss::wait) {
        controller->connection.reset();
        return;
    }
    session_->detach(controller->client);
    controllers_.remove(gone);
    if (is_expected && !(has_started_ && controllers_.empty())) return;
    if (!is_expected && settings_.on_loss == OnLoss::stop && !controllers_.empty()) return;
    end_run(is_expected ? "done" : "lost",
            is_expected
                ? ""
                : fmt::format(
                      "controller {} has disconnected at {} s without a message of type \"bye\"",
                      name, seconds(session_->network().now())));
}

void Lockstep::answer(Controller& controller) {
    const std::string_view line =
        answers_->state(controller.hello, controller.step.number, controller.sent,
                        session_->heard(controller.client));
    controller.state = Controller::State::owes;
    if (settings_.on_loss == OnLoss::wait) controller.last_state = line;
    if (controller.connection) carrier_.send(*controller.connection, line);
}

/// Begins the next step, or ends the run, if every controller has sent its request.
void Lockstep::go_on() {
    if (step_end_ || !goes_on() || !has_started_ || !controllers_.have_all_asked()) return;
    remove_leaving();
    if (is_over_) return;
    const Time end = controllers_.next_end();
    if (end == never) {
        new_seed_ = controllers_.begin()->reset_seed.value_or(seed_);
        return;
    }
    controllers_.carry_out(*session_);
    step_end_ = end;
}

void Lockstep::tell() {
    const Time end = *step_end_;
    step_end_.reset();
    for (Controller& each : controllers_) {
        if (each.state == Controller::State::waits && each.step_end == end) answer(each);
    }
    catch_up();
}

/// Handles what has come during a step.
void Lockstep::catch_up() {
    while (!after_step_.empty() && !step_end_ && goes_on()) {
        const auto next = std::move(after_step_.front());
        after_step_.pop_front();
        next();
        go_on();
    }
}

void Lockstep::held(std::chrono::nanoseconds waited) {
    const std::size_t present = controllers_.size(), wanted = settings_.wait_for;
    if (!has_started_ && settings_.programs && *settings_.programs < wanted) {
        return end_run("lost", "a controller has ended before it sent a message of type \"hello\"");
    }
    if (!has_started_ && told_present_ != present) {
        told_present_ = present;
        settings_.say(fmt::format("waiting for controllers: {} of {} {} connected", present, wanted,
                                  present == 1 ? "is" : "are"));
    }
    if (settings_.patience && waited >= *settings_.patience) end_if_slow();
}

/// Ends the run if it waits for controllers, or for programs that have said no hello.
void Lockstep::end_if_slow() {
    const std::chrono::duration<double> patience = *settings_.patience;
    if (has_started_) {
        return end_run("patience",
                       fmt::format("no request within {:g} s from controller {}", patience.count(),
                                   fmt::join(controllers_.owing(), ", ")));
    }
    std::vector<std::string> commands;
    for (const auto& [connection, command] : silent_) {
        commands.push_back(fmt::format("\"{}\"", command));
    }
    if (commands.empty()) return;
    end_run("patience", fmt::format("no message of type \"hello\" within {:g} s from controller {}",
                                    patience.count(), fmt::join(commands, ", ")));
}

std::chrono::milliseconds Lockstep::time_to_end() const {
    constexpr std::chrono::milliseconds shortest{400};
    const std::chrono::milliseconds usual = Front::time_to_end();
    if (reason_ != "patience") return usual;
    return std::clamp(std::chrono::ceil<std::chrono::milliseconds>(*settings_.patience), shortest,
                      usual);
}

void Lockstep::end_run(std::string reason, std::string fault) {
    if (std::exchange(is_over_, true)) return;
    reason_ = std::move(reason);
    fault_ = std::move(fault);
}

void Lockstep::ended(std::string_view fingerprint, const Table& metrics) {
    const std::string line = end_line(reason_, fingerprint, metrics);
    for (const Connection to : leaving_) carrier_.send(to, line);
    for (const Controller& each : controllers_) {
        if (each.connection) carrier_.send(*each.connection, line);
    }
}

}  // namespace rovernet
