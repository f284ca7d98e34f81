// SPDX-License-Identifier: MIT
// Runs with clients of several kinds at once are made again from their log, without the clients.
#include "live/input_replay.hpp"
#include "live/lockstep/stepped_run.hpp"
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
#include <utility>
#include <vector>

namespace replay_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

TEST_CASE("replay: a run with Player and ROS clients is reproduced") {
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
    for (const char* input : {R"("robot":"A","do":{"v":)", R"("robot":"A","do":{"to":)",
                              R"("robot":"B","do":{"v":)", R"("robot":"B","do":{"to":)"}) {
        CAPTURE(input);
        CHECK(run.log().find(input) != std::string::npos);
    }
}

TEST_CASE("replay: a run with controllers over TCP and WebSocket is reproduced") {
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

TEST_CASE("replay: a log with a command that no client could send is refused, with its line") {
    const TemporaryFolder folder;
    folder.write("scenario.toml", live_row);
    const auto log = [&](const std::string& format, const std::string& what) {
        return folder.write("inputs.jsonl",
                            "{" + format +
                                "\"version\":\"0\",\"scenario\":\"0\",\"seed\":1}\n"
                                "{\"t_ns\":0,\"n\":1,\"client\":\"A\",\"robot\":\"A\",\"do\":" +
                                what + "}\n");
    };
    for (const std::string what :
         {R"("velocity","v":1e308,"w":0)", R"("velocity","v":1,"w":-1001)",
          R"("goal","goal":[1,2e9,0],"speed":1)", R"("goal","goal":[1,2,0],"speed":1e9)",
          R"("goal","speed":1)", R"("place","at":[1,2,-1e10],"heading":0)",
          R"("place","place":[1,2,0],"heading":0)", R"("dance")", R"("send","to":"Z","data":"")",
          R"("send","to":"*","hops":2,"data":"")", R"({"v":1})", R"("stop","x":1)"}) {
        CAPTURE(what);
        CHECK_THROWS_WITH_AS(replay_inputs(log("", what), {}), doctest::Contains("inputs.jsonl:2"),
                             InputError);
    }
    for (const std::string what :
         {R"({"v":1e308,"w":0})", R"({"v":1,"w":-1001})", R"({"goal":[1,2e9,0],"speed":1})",
          R"({"goal":[1,2,0],"speed":1e9})", R"({"place":[1,2,-1e10],"heading":0})", R"({})",
          R"({"speed":1})", R"({"v":1,"stop":true})", R"({"stop":false})", R"("stop")",
          R"({"at":[1,2,0]})", R"({"to":"Z","data":""})", R"({"v":1,"timeout":"0 s"})",
          R"({"to":"*"})", R"({"v":1},"w":1)"}) {
        CAPTURE(what);
        CHECK_THROWS_WITH_AS(replay_inputs(log("\"format\":2,", what), {}),
                             doctest::Contains("inputs.jsonl:2"), InputError);
    }
    CHECK_THROWS_WITH_AS(replay_inputs(log("\"format\":3,", R"({"v":1})"), {}),
                         doctest::Contains("inputs.jsonl:1"), InputError);
}

TEST_CASE("replay: a log of the first format, with every command, still gives the same run") {
    const InputReplay replay =
        replay_inputs(ROVERNET_TEST_DATA "/../live/inputs/format_1.jsonl", {});
    CHECK(replay.recorded == "12a28150be87ad36");
    CHECK(replay.now == replay.recorded);
    CHECK(replay.inputs == 11);
}

TEST_CASE(
    "replay: every command is logged with the keys of the lock-step protocol, and is reproduced") {
    const TemporaryFolder folder;
    SteppedRun run(three_in_a_row(), {.folder = folder.path("run")});
    const std::vector<std::pair<std::size_t, RobotCommand>> commands = {
        {0, DriveCommand{{-0.0}, {0.1}, 350ms}},
        {1, DriveCommand{{1}, {-1e-300}}},
        {1, GoalCommand{{17.5, 3, 0}, {1.5}}},
        {2, PlaceCommand{{302, -1, 0.25}, {-0.75}}},
        {0, SendCommand{.payload = "flood \"\n"}},
        {1, SendCommand{.to = NodeId{2}, .port = 7, .payload = "one", .size = 100}},
        {1, SendCommand{.port = 9, .one_hop = true}},
        {1, StopCommand{}},
    };
    for (const auto& [row, command] : commands) {
        run.command(row, command);
        run.step(256, [] { return true; });
    }
    const std::string fingerprint = run.finish().fingerprint;
    const InputReplay replay = replay_inputs(folder.path("run"), {});
    CHECK(replay.now == fingerprint);
    const std::string log = content(folder.path("run/inputs.jsonl"));
    std::string told;
    for (std::size_t at = log.find("\"do\":"); at != log.npos; at = log.find("\"do\":", at + 1)) {
        told += log.substr(at + 5, log.find('\n', at) - at - 6) + "\n";
    }
    CHECK(told == R"({"v":-0.0,"w":0.1,"timeout":"0.35 s"}
{"v":1.0,"w":-1e-300}
{"goal":[17.5,3.0,0.0],"speed":1.5}
{"place":[302.0,-1.0,0.25],"heading":-0.75}
{"to":"*","port":0,"data":"Zmxvb2QgIgo=","one_hop":false}
{"to":"C","port":7,"data":"b25l","size":100,"one_hop":false}
{"to":"*","port":9,"data":"","one_hop":true}
{"stop":true}
{"stop":true}
{"stop":true}
{"stop":true}
)");
}

}  // namespace replay_test
