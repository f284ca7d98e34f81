// SPDX-License-Identifier: MIT
#include "live/lockstep/controllers.hpp"

#include <algorithm>
#include <iterator>

namespace rovernet {

Controller::Controller(std::optional<Connection> from, HelloRequest hello_of)
    : connection(from), hello(std::move(hello_of)), own(hello.robots) {
    std::sort(own.begin(), own.end());
}

void Controller::join(Session& session) {
    client = session.attach(hello.robots, hello.name, hello.observes_heard);
    state = State::owes;
    has_stepped = false;
    step.commands.clear();
    sent.clear();
    last_state.clear();
}

void Controller::ask(const Session& session, StepRequest& request) {
    const Time now = session.network().now();
    state = State::waits;
    has_stepped = true;
    step.number = request.number;
    step.commands.swap(request.commands);
    step_end = now + std::min(hello.step, session.end() - now);
    sent.clear();
}

Controller* Controllers::of(Connection connection) {
    const auto found = std::find_if(all_.begin(), all_.end(), [&](const Controller& each) {
        return each.connection == connection;
    });
    return found == all_.end() ? nullptr : &*found;
}

Controller* Controllers::named(std::string_view name) {
    const auto found = std::find_if(
        all_.begin(), all_.end(), [&](const Controller& each) { return each.hello.name == name; });
    return found == all_.end() ? nullptr : &*found;
}

void Controllers::remove(Connection connection) {
    std::erase_if(all_, [&](const Controller& each) { return each.connection == connection; });
}

std::vector<Controller> Controllers::take_leaving() {
    const auto leaving = std::stable_partition(
        all_.begin(), all_.end(),
        [](const Controller& each) { return each.state != Controller::State::leaves; });
    std::vector<Controller> taken(std::make_move_iterator(leaving),
                                  std::make_move_iterator(all_.end()));
    all_.erase(leaving, all_.end());
    std::sort(taken.begin(), taken.end(), [](const Controller& a, const Controller& b) {
        return a.own.front() < b.own.front();
    });
    return taken;
}

std::vector<std::string> Controllers::owing() const {
    std::vector<std::string> names;
    for (const Controller& each : all_) {
        if (each.state == Controller::State::owes) names.push_back(each.hello.name);
    }
    return names;
}

bool Controllers::have_all_asked() const {
    return !all_.empty() && std::none_of(all_.begin(), all_.end(), [](const Controller& each) {
        return each.state == Controller::State::owes;
    });
}

Time Controllers::next_end() const {
    Time nearest = never;
    for (const Controller& each : all_) {
        if (each.state == Controller::State::waits) nearest = std::min(nearest, each.step_end);
    }
    return nearest;
}

void Controllers::carry_out(Session& session) {
    due_.clear();
    for (Controller& each : all_) {
        for (const auto& [robot, command] : each.step.commands) {
            due_.push_back({robot, &each, &command});
        }
    }
    const auto before = [](const Due& a, const Due& b) { return a.robot < b.robot; };
    if (!std::is_sorted(due_.begin(), due_.end(), before)) {
        std::stable_sort(due_.begin(), due_.end(), before);
    }
    for (const auto& [robot, controller, command] : due_) {
        const auto uid =
            session.carry_out(controller->client, robot, *command, controller->step.number);
        if (uid) controller->sent.push_back({*uid, robot});
    }
    for (Controller& each : all_) each.step.commands.clear();
}

}  // namespace rovernet
