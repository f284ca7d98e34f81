// SPDX-License-Identifier: MIT
#include "live/lockstep.hpp"

#include "experiment/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace rovernet {

/// A controller: one that is there, or one that time waits for.
struct Lockstep::Controller {
    enum State { owes, waits, wants_reset, leaves };

    std::optional<Connection> connection;
    HelloRequest hello;
    std::vector<NodeId> own = {};  // robots, in order
    ClientId client = 0;
    State state = owes;
    Time step_end = start_of_run;          // of the step that it waits for
    std::optional<StepRequest> step = {};  // not carried out yet
    std::uint64_t number = 0;              // of its last step
    bool has_stepped = false;
    std::optional<std::uint64_t> reset_seed = {};
    std::vector<SentMessage> sent = {};
    std::string last_state = {};  // for when it comes back
};

Lockstep::Lockstep(Settings settings, Tell tell) : settings_(settings), tell_(std::move(tell)) {}
Lockstep::~Lockstep() = default;

void Lockstep::begin(Session& session, const Scenario& scenario,
                     std::function<std::string()> fingerprint) {
    session_ = &session;
    scenario_ = &scenario;
    fingerprint_ = std::move(fingerprint);
    answers_.emplace(session, scenario);
    seed_ = scenario.scenario.seed;
    state_ = State::runs;
    session.step(start_of_run);  // movements may draw where robots begin
    for (auto& controller : controllers_) {
        join(*controller);
        if (has_started_ && controller->connection) {
            tell_(*controller->connection, answers_->welcome(controller->hello));
        }
    }
}

Lockstep::Controller* Lockstep::controller_of(Connection connection) {
    const auto found =
        std::find_if(controllers_.begin(), controllers_.end(),
                     [&](const auto& each) { return each->connection == connection; });
    return found == controllers_.end() ? nullptr : found->get();
}

bool Lockstep::is_done() const { return session_->network().now() >= session_->end(); }

void Lockstep::receive(Connection from, std::string_view line) {
    if (state_ != State::runs) return;
    try {
        const Controller* controller = controller_of(from);
        Request request = reader_.read(
            line, session_->network(),
            controller ? std::span<const NodeId>(controller->own) : std::span<const NodeId>());
        std::visit([&](auto& each) { handle(from, each); }, request);
    } catch (const RequestError& fault) {
        tell_(from, error_line(fault, reader_.number()));
    }
}

/// Puts a controller of the session's start to its robots.
void Lockstep::join(Controller& controller) {
    controller.client = session_->attach(controller.hello.robots, controller.hello.name);
    controller.state = Controller::owes;
    controller.has_stepped = false;
    controller.step.reset();
    controller.sent.clear();
    controller.last_state.clear();
}

/// Lets a controller that was lost go on where it was. @return whether it is one
bool Lockstep::come_back(Connection from, const HelloRequest& hello) {
    const auto found = std::find_if(
        controllers_.begin(), controllers_.end(),
        [&](const auto& each) { return !each->connection && each->hello.name == hello.name; });
    if (found == controllers_.end()) return false;
    Controller& controller = **found;
    if (controller.hello.robots != hello.robots || controller.hello.step != hello.step) {
        throw RequestError(
            "taken", "name",
            fmt::format("{} had other robots or another step when it was lost", hello.name));
    }
    controller.connection = from;
    controller.hello = hello;
    tell_(from, answers_->welcome(hello));
    if (!controller.last_state.empty()) tell_(from, controller.last_state);
    return true;
}

void Lockstep::check_claims(const HelloRequest& hello) const {
    for (const auto& each : controllers_) {
        if (each->hello.name == hello.name) {
            throw RequestError("taken", "name",
                               fmt::format("there is a controller {} already", hello.name));
        }
    }
    for (std::size_t i = 0; i < hello.robots.size(); ++i) {
        if (!session_->driver(hello.robots[i])) continue;
        throw RequestError("taken", fmt::format("robots[{}]", i),
                           fmt::format("robot {} is another controller's",
                                       session_->network().name(hello.robots[i])));
    }
    const bool is_free =
        !has_started_ && std::none_of(controllers_.begin(), controllers_.end(),
                                      [](const auto& each) { return each->hello.seed; });
    if (hello.seed && *hello.seed != seed_ && !is_free) {
        throw RequestError("other_seed", "seed",
                           fmt::format("found {}; the run has {}", *hello.seed, seed_));
    }
}

void Lockstep::handle(Connection from, HelloRequest& hello) {
    if (controller_of(from)) {
        throw RequestError("hello_again", "type", "you have said hello already");
    }
    if (hello.name.empty()) hello.name = session_->network().name(hello.robots.front());
    if (come_back(from, hello)) return;
    check_claims(hello);
    if (hello.seed) seed_ = *hello.seed;
    auto controller = std::make_unique<Controller>(Controller{from, hello});
    controller->own = hello.robots;
    std::sort(controller->own.begin(), controller->own.end());
    join(*controller);
    controllers_.push_back(std::move(controller));
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
    for (const auto& each : controllers_) {
        tell_(*each->connection, answers_->welcome(each->hello));
    }
}

/// The controller of a line that asks for something.
Lockstep::Controller& Lockstep::asking(Connection from) {
    Controller* controller = controller_of(from);
    if (!controller) throw RequestError("hello_first", "type", "expected a hello first");
    if (!has_started_) {
        throw RequestError("too_early", "",
                           fmt::format("{} of {} controllers are there; wait for "
                                       "the welcome",
                                       present(), wanted()));
    }
    if (controller->state != Controller::owes) {
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
    controller.state = Controller::waits;
    controller.has_stepped = true;
    controller.number = step.number;
    controller.step_end =
        session_->network().now() +
        std::min(controller.hello.step, session_->end() - session_->network().now());
    controller.step = std::move(step);
}

void Lockstep::handle(Connection from, ResetRequest& reset) {
    Controller& controller = asking(from);
    for (const auto& each : controllers_) {
        if (each->state != Controller::wants_reset || each->reset_seed == reset.seed) continue;
        throw RequestError("other_seed", "seed", "another controller asks for another seed");
    }
    controller.state = Controller::wants_reset;
    controller.reset_seed = reset.seed;
}

void Lockstep::handle(Connection from, ByeRequest&) { asking(from).state = Controller::leaves; }

/// Lets go those who said bye, by robot. The last of them end the run.
void Lockstep::let_go() {
    std::vector<Controller*> leaving;
    for (const auto& each : controllers_) {
        if (each->state == Controller::leaves) leaving.push_back(each.get());
    }
    if (leaving.empty()) return;
    std::sort(leaving.begin(), leaving.end(), [](const Controller* a, const Controller* b) {
        return a->own.front() < b->own.front();
    });
    for (const Controller* each : leaving) {
        session_->detach(each->client);
        if (each->connection) leaving_.push_back(*each->connection);
    }
    std::erase_if(controllers_, [](const auto& each) { return each->state == Controller::leaves; });
    if (controllers_.empty()) return end_run("bye", {});
    Table metrics;
    append_metrics(metrics, session_->network().metrics());
    const std::string line = end_line("bye", fingerprint_(), metrics);
    for (const Connection to : std::exchange(leaving_, {})) tell_(to, line);
}

/// Takes a controller out; its robots stand still.
void Lockstep::remove(Connection connection) {
    session_->detach(controller_of(connection)->client);
    std::erase_if(controllers_, [&](const auto& each) { return each->connection == connection; });
}

void Lockstep::lost(Connection connection) {
    std::erase(leaving_, connection);
    Controller* controller = controller_of(connection);
    if (!controller || state_ == State::over) return;
    const std::string name = controller->hello.name;
    const bool is_expected = !has_started_ || is_done();
    if (!is_expected && settings_.on_loss == OnLoss::wait) {
        controller->connection.reset();
        return;
    }
    remove(connection);
    if (is_expected && !(has_started_ && controllers_.empty())) return;
    if (!is_expected && settings_.on_loss == OnLoss::stop && !controllers_.empty()) return;
    end_run(is_expected ? "done" : "lost",
            is_expected ? ""
                        : fmt::format("controller {} has gone at {} s without a bye", name,
                                      seconds(session_->network().now())));
}

bool Lockstep::is_due() const {
    return state_ == State::runs && has_started_ && !controllers_.empty() &&
           std::none_of(controllers_.begin(), controllers_.end(),
                        [](const auto& each) { return each->state == Controller::owes; });
}

std::vector<std::string> Lockstep::owing() const {
    std::vector<std::string> names;
    for (const auto& each : controllers_) {
        if (each->state == Controller::owes) names.push_back(each->hello.name);
    }
    return names;
}

/// Nearest end of a step; never if everybody wants a reset.
Time Lockstep::next_end() const {
    Time nearest = never;
    for (const auto& each : controllers_) {
        if (each->state == Controller::waits) nearest = std::min(nearest, each->step_end);
    }
    return nearest;
}

/// Carries out the commands of those who have asked now, by robot.
void Lockstep::carry_out() {
    std::vector<std::tuple<NodeId, Controller*, const RobotCommand*>> commands;
    for (const auto& each : controllers_) {
        if (!each->step) continue;
        for (const auto& [robot, command] : each->step->commands) {
            commands.emplace_back(robot, each.get(), &command);
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
    for (const auto& each : controllers_) each->step.reset();
}

void Lockstep::answer(Controller& controller) {
    const std::string_view line = answers_->state(
        controller.hello, controller.number, controller.sent, session_->heard(controller.client));
    controller.state = Controller::owes;
    controller.sent.clear();
    if (settings_.on_loss == OnLoss::wait) controller.last_state = line;
    if (controller.connection) tell_(*controller.connection, line);
}

void Lockstep::advance(const std::function<bool()>& go_on) {
    constexpr std::uint64_t events_a_slice = 256;  // each may reach thousands of robots
    let_go();
    if (state_ == State::over) return;
    const Time end = next_end();
    if (end == never) {
        seed_ = controllers_.front()->reset_seed.value_or(seed_);
        state_ = State::restarts;
        return;
    }
    carry_out();
    while (!session_->advance(end, events_a_slice)) {
        if (go_on()) continue;
        session_->step(session_->network().now());  // all of that time, as a replay does
        return end_run("stopped", {});
    }
    for (const auto& each : controllers_) {
        if (each->state == Controller::waits && each->step_end == end) answer(*each);
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
    for (const auto& each : controllers_) {
        if (each->connection) tell_(*each->connection, line);
    }
}

}  // namespace rovernet
