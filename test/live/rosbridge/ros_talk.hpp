// SPDX-License-Identifier: MIT
#pragma once

#include "live/rosbridge/front.hpp"
#include "scenario/scenario.hpp"
#include "test/live/run_front.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rovernet::test {

using Json = nlohmann::json;

/// ROS clients and a session without sockets and clock: the test passes the messages, and advances
/// the time.
class RosTalk {
  public:
    explicit RosTalk(Scenario scenario)
        : scenario_(std::move(scenario)),
          session(scenario_),
          front({.send = [this](auto to, auto text) { told_[to].push_back(Json::parse(text)); },
                 .close = [](auto) {},
                 .send_binary = [this](auto to,
                                       auto bytes) { told_[to].push_back(decoded(bytes)); }}) {
        session.step(start_of_run);
        front.begin(session, scenario_);
        front.opened(0, {});
    }

    void come(Front::Connection client) { front.opened(client, {}); }
    void go(Front::Connection client) { front.closed(client); }
    void say(const std::string& message, Front::Connection client = 0) {
        front.received(client, message);
    }
    /// Messages that a client has received since the last call.
    std::vector<Json> told(Front::Connection client = 0) {
        return std::exchange(told_[client], {});
    }
    std::vector<Json> ask(const std::string& message, Front::Connection client = 0) {
        told(client);
        say(message, client);
        return told(client);
    }
    /// Calls a service. @return values of the answer; all answers unless there is exactly one, with
    /// success
    Json call(const std::string& service, const Json& args = Json::object()) {
        const auto answers = ask(
            Json{{"op", "call_service"}, {"id", "1"}, {"service", service}, {"args", args}}.dump());
        if (answers.size() != 1 || answers[0]["result"] != true) return answers;
        return answers[0]["values"];
    }
    void subscribe(const std::string& topic, Json more = Json::object()) {
        more.update({{"op", "subscribe"}, {"topic", topic}});
        say(more.dump());
    }
    void publish(const std::string& topic, const Json& message, Front::Connection client = 0) {
        say(Json{{"op", "publish"}, {"topic", topic}, {"msg", message}}.dump(), client);
    }
    /// Messages of a topic that a client has received since the last call; its other messages are
    /// discarded.
    std::vector<Json> messages(const std::string& topic, Front::Connection client = 0) {
        std::vector<Json> found;
        for (Json& each : told(client)) {
            if (each["op"] == "publish" && each["topic"] == topic) found.push_back(each["msg"]);
        }
        return found;
    }

    void run_until(Duration time) {
        run_front(session, front, std::min(start_of_run + time, session.end()));
    }
    void run_for(Duration time) { run_until(session.network().now().time_since_epoch() + time); }

  private:
    /// Converts CBOR to JSON; typed arrays become binary values.
    static Json decoded(std::string_view bytes) {
        return Json::from_cbor(bytes, true, true, Json::cbor_tag_handler_t::ignore);
    }

    Scenario scenario_;
    std::map<Front::Connection, std::vector<Json>> told_;

  public:
    Session session;
    RosbridgeFront front;
};

}  // namespace rovernet::test
