// SPDX-License-Identifier: MIT
// Runs with clients of several kinds at once are made again from their log, without the clients.
#include "live/input_replay.hpp"
#include "live/player/listeners.hpp"
#include "live/rosbridge/listener.hpp"
#include "sim/error.hpp"
#include "test/live/live_command.hpp"
#include "test/live/served_run.hpp"
#include "test/live/talk.hpp"
#include "test/live/web_client.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace replay_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

TEST_CASE("replay: a run with clients of Player and of ROS") {
    const Address any{"127.0.0.1", 0};
    ServedRun run(three_in_a_row("[access]\nmodel = \"csma\"\n"),
                  {player_one_port(any, {"A"}, {}), rosbridge_listener(any)}, 2);
    LineClient player(run.port("(Player, all robots)"));
    WebClient ros(run.port("(rosbridge)"));
    open_position(player);
    player.send_bytes(device(51, 1));
    for (int i = 1; i <= 20; ++i, std::this_thread::sleep_for(20ms)) {
        const std::string number = std::to_string(i);
        player.send_bytes(rovernet::test::drive(0.1 * i, -0.2) + order(51, 1, counted(number)));
        ros.send(R"({"op":"publish","topic":"/B/cmd_vel","msg":{"linear":{"x":0.)" + number +
                 "}}}");
        ros.send(R"({"op":"publish","topic":"/B/radio/send","msg":{"data":"Rg=="}})");
    }
    const LiveResult result = run.end();
    const InputReplay replay = run.replay();
    CHECK(replay.inputs >= 80);
    CHECK(replay.recorded == result.run.fingerprint);
    CHECK(replay.now == result.run.fingerprint);
    for (const char* input : {R"("robot":"A","do":"velocity")", R"("robot":"A","do":"send")",
                              R"("robot":"B","do":"velocity")", R"("robot":"B","do":"send")"}) {
        CAPTURE(input);
        CHECK(run.log().find(input) != std::string::npos);
    }
}

TEST_CASE("replay: a run with controllers by TCP and by WebSocket") {
    const Live live(
        {"--listen-json", "127.0.0.1:0", "--listen-web", "127.0.0.1:0", "--wait-for", "2"});
    LineClient a(live.port());
    WebClient b(read_port(live.said("listening on ws://")));
    const auto words = [](const std::string& robot, int n) {
        return R"({"type":"step","n":)" + std::to_string(n) + R"(,"do":{")" + robot +
               R"(":{"v":0.)" + std::to_string(n) + R"(,"w":-0.0}},"send":[{"from":")" + robot +
               R"(","data":"Rg=="}]})";
    };
    a.send_bytes(hello("\"A\"") + "\n");
    b.send(hello("\"B\"", "50 ms"));
    CHECK(Json::parse(a.line()).at("type") == "welcome");
    CHECK(Json::parse(b.message()).at("type") == "welcome");
    for (int n = 1; n <= 20; ++n) {
        a.send_bytes(words("A", n) + "\n");
        for (int k = 2 * n - 1; k <= 2 * n; ++k) {
            CHECK(Json::parse(b.ask(words("B", k))).at("type") == "state");
        }
        CHECK(Json::parse(a.line()).at("type") == "state");
    }
    a.send_bytes("{\"type\":\"bye\"}\n");
    b.send(R"({"type":"bye"})");
    CHECK(live.wait().exit == 0);
    CHECK(live.replay().out == "identical: 122 inputs, fingerprint " + live.fingerprint() + "\n");
}

TEST_CASE("replay: numbers that no client could have said are refused, with their line") {
    const TemporaryFolder folder;
    folder.write("scenario.toml", live_row);
    for (const std::string what :
         {R"("do":"velocity","v":1e308,"w":0)", R"("do":"velocity","v":1,"w":-1001)",
          R"("do":"goal","goal":[1,2e9,0],"speed":1)", R"("do":"goal","goal":[1,2,0],"speed":1e9)",
          R"("do":"place","at":[1,2,-1e10],"heading":0)"}) {
        CAPTURE(what);
        const std::string log =
            folder.write("inputs.jsonl",
                         "{\"version\":\"0\",\"scenario\":\"0\",\"seed\":1}\n"
                         "{\"t_ns\":0,\"n\":1,\"client\":\"A\",\"robot\":\"A\"," +
                             what + "}\n");
        CHECK_THROWS_WITH_AS(replay_inputs(log, {}), doctest::Contains("inputs.jsonl:2"),
                             InputError);
    }
}

}  // namespace replay_test
