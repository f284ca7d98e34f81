// SPDX-License-Identifier: MIT
// The rosbridge server by real sockets, and its log. test/npm/roslib.mjs is a client of others.
#include "live/rosbridge/listener.hpp"

#include "live/input_replay.hpp"
#include "test/live/talk.hpp"
#include "test/live/web_client.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <future>
#include <string>

namespace rosbridge_listener_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;
using Json = nlohmann::json;

namespace {

/// A run by the clock with a rosbridge listener, in a separate thread.
class Server {
  public:
    Server() {
        PacedOptions options;
        options.folder = folder_.path("out");
        options.fronts.push_back(rosbridge_listener({"127.0.0.1", 0}));
        options.stop.go_on = [this] { return !stopped_; };
        std::promise<int> opened;
        options.say = [&](std::string_view text) {
            const std::string words = "listening on 127.0.0.1:";
            if (text.starts_with(words)) {
                opened.set_value(std::stoi(std::string(text.substr(words.size()))));
            }
        };
        run_ = std::async(std::launch::async,
                          [options] { return run_paced(three_in_a_row(), options); });
        port = opened.get_future().get();
    }
    ~Server() { stopped_ = true; }

    LiveResult stop() {
        stopped_ = true;
        return run_.get();
    }
    InputReplay replay() const { return replay_inputs(folder_.path("out"), {}); }

    int port = 0;

  private:
    TemporaryFolder folder_;
    std::atomic<bool> stopped_ = false;
    std::future<LiveResult> run_;
};

/// Values of the answer to a call.
Json call(WebClient& client, const std::string& service, const Json& args = Json::object()) {
    client.send(Json{{"op", "call_service"}, {"service", service}, {"args", args}}.dump());
    for (;;) {
        const std::string message = client.message();
        REQUIRE_FALSE(message.empty());
        const Json answer = Json::parse(message);
        if (answer["op"] == "service_response") return answer["values"];
    }
}

}  // namespace

TEST_CASE(
    "rosbridge listener: clients drive robots by WebSocket while time is paused and stepped") {
    Server server;
    WebClient client(server.port);
    call(client, "/simulation/pause");
    const Json begin = call(client, "rosapi/get_time")["time"];
    client.send(R"({"op":"publish","topic":"/A/cmd_vel","msg":{"linear":{"x":1}}})");
    client.send(R"({"op":"subscribe","topic":"/A/odom","compression":"cbor"})");
    CHECK(call(client, "rosapi/get_time")["time"] == begin);
    client.send(R"({"op":"call_service","service":"/simulation/step","args":{"seconds":0.05}})");
    const WebClient::Frame odometry = client.frame();
    CHECK(odometry.kind == WebClient::binary);
    const Json message =
        Json::from_cbor(odometry.bytes, true, true, Json::cbor_tag_handler_t::ignore)["msg"];
    const double driven =
        message["header"]["stamp"]["sec"].get<double>() - begin["sec"].get<double>() +
        (message["header"]["stamp"]["nanosec"].get<double>() - begin["nanosec"].get<double>()) /
            1e9;
    CHECK(std::abs(message["pose"]["pose"]["position"]["x"].get<double>() - driven) < 1e-9);
    CHECK(Json::parse(client.frame().bytes)["op"] == "service_response");
    const LiveResult result = server.stop();
    CHECK(client.reason() == 1001);
    const InputReplay replay = server.replay();
    CHECK(replay.inputs == 1);
    CHECK(replay.now == result.run.fingerprint);
}

TEST_CASE(
    "rosbridge listener: robots of a killed client stop, and no state of the client remains") {
    Server server;
    WebClient watcher(server.port);
    call(watcher, "/simulation/pause");
    for (int i = 0; i < 100; ++i) {
        WebClient client(server.port);
        client.send(R"({"op":"subscribe","topic":"/clock","queue_length":5})");
        client.send(R"({"op":"publish","topic":"/B/cmd_vel","msg":{"linear":{"x":1}}})");
        call(client, "rosapi/get_time");
        client.socket().reset();
    }
    const LiveResult result = server.stop();
    CHECK(watcher.reason() == 1001);
    const InputReplay replay = server.replay();
    CHECK(replay.inputs >= 199);  // each drives and, but for the last maybe, stops as it is gone
    CHECK(replay.now == result.run.fingerprint);
}

}  // namespace rosbridge_listener_test
