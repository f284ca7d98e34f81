// SPDX-License-Identifier: MIT
// The command `live` with controllers at its listeners, in processes and sockets of their own.
#include "test/live/live_command.hpp"
#include "test/live/web_client.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace live_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// Controller for every kind of connection.
const std::string python = R"(import json, sys
def ask(**q):
    print(json.dumps(q), flush=True)
    return json.loads(sys.stdin.readline())
ask(type="hello", protocol=1, robots=["A", "B"], step="100 ms")
for n in range(1, 21):
    send = [{"from": "B", "to": "*", "port": n, "data": "Rg=="}] if n % 3 == 0 else []
    ask(type="step", n=n, do={"A": {"v": 0.1 * n, "w": 0.3}}, send=send)
ask(type="bye")
)";

/// The same words as the program above. @return the last line
template <class Client>
std::string drive(Client& client) {
    client.ask(hello(R"("A","B")"));
    for (int n = 1; n <= 20; ++n) {
        Json question{{"type", "step"}, {"n", n}};
        question["do"]["A"] = Json{{"v", 0.1 * n}, {"w", 0.3}};
        if (n % 3 == 0) {
            question["send"] =
                Json::array({Json{{"from", "B"}, {"to", "*"}, {"port", n}, {"data", "Rg=="}}});
        }
        CHECK(Json::parse(client.ask(question.dump())).at("type") == "state");
    }
    return client.ask(R"({"type":"bye"})");
}

/// A controller of one robot that takes its time.
void drive_slowly(LineClient& client, const std::string& robot, std::uint64_t seed) {
    client.ask(hello("\"" + robot + "\""));
    for (int n = 1; n <= 20; ++n) {
        const auto number = static_cast<std::uint64_t>(n + robot[0]) * 2654435761U;
        std::this_thread::sleep_for(std::chrono::microseconds((seed * number >> 8U) % 5000));
        const std::string n_text = std::to_string(n);
        client.ask(R"({"type":"step","n":)" + n_text + R"(,"do":{")" + robot + R"(":{"v":0.)" +
                   n_text + R"(}},"send":[{"from":")" + robot + R"(","data":"Rg=="}]})");
    }
    client.ask(R"({"type":"bye"})");
}

}  // namespace

TEST_CASE(
    "live: a controller gives the same run over every kind of connection, and in the replay of its "
    "log") {
    const Live by_stdio({"--controller", "PROGRAM"}, live_row, python);
    CHECK(by_stdio.wait().exit == 0);
    const std::string fingerprint = by_stdio.fingerprint();

    const Live by_tcp({"--listen-json", "127.0.0.1:0"});
    LineClient tcp(by_tcp.port());
    CHECK(Json::parse(drive(tcp)).at("fingerprint") == fingerprint);
    CHECK(by_tcp.wait().exit == 0);
    CHECK(by_tcp.fingerprint() == fingerprint);

    const Live by_path({"--unix", "SOCKET"});
    by_path.said("listening on ");
    LineClient local(by_path.folder.path("socket"));
    CHECK(Json::parse(drive(local)).at("fingerprint") == fingerprint);
    CHECK(by_path.wait().exit == 0);
    CHECK_FALSE(std::filesystem::exists(by_path.folder.path("socket")));

    const Live by_web({"--listen-web", "127.0.0.1:0"});
    WebClient web(read_port(by_web.said("listening on ws://")));
    CHECK(Json::parse(drive(web)).at("fingerprint") == fingerprint);
    CHECK(web.reason() == 1001);
    CHECK(by_web.wait().exit == 0);

    const Live beside({"--controller", "PROGRAM", "--player", "127.0.0.1:0", "--rosbridge",
                       "127.0.0.1:0", "--speed", "100"},
                      live_row, python);
    CHECK(beside.wait().exit == 0);
    CHECK(beside.fingerprint() == fingerprint);
    CHECK(beside.replay().exit == 0);

    const Ended again = by_stdio.replay();
    CHECK(again.exit == 0);
    CHECK(again.out == "identical: 28 inputs, fingerprint " + fingerprint + "\n");
}

TEST_CASE("live: a changed input log is refused, and an incomplete log is replayed up to its end") {
    const Live live({"--controller", "PROGRAM"}, live_row, python);
    REQUIRE(live.wait().exit == 0);
    const std::string path = live.folder.path("out/inputs.jsonl"), log = content(path);
    const auto changed = [&](const std::string& text) {
        live.folder.write("out/inputs.jsonl", text);
        return live.replay();
    };
    std::string other = log;
    other.replace(other.find("\"v\":0.5"), 7, "\"v\":0.6");
    CHECK(changed(other).exit == 1);
    CHECK(changed(other).err.find("has a different fingerprint than the recorded run") !=
          std::string::npos);
    const std::size_t last = log.rfind('\n', log.size() - 2);
    const Ended cut = changed(log.substr(0, last - 5));
    CHECK(cut.exit == 0);
    CHECK(cut.out.find("without the fingerprint of the run") != std::string::npos);
    const Ended broken = changed(log.substr(0, 100) + "\n{\"t_ns\":-1}\n");
    CHECK(broken.exit == 3);
    CHECK(broken.err.find("inputs.jsonl:") != std::string::npos);
}

TEST_CASE("live: how long controllers take in real time does not affect results") {
    std::vector<std::string> fingerprints;
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Live live({"--listen-json", "127.0.0.1:0", "--wait-for", "2"});
        LineClient a(live.port()), b(live.port());
        std::thread other([&] { drive_slowly(a, "A", seed); });
        drive_slowly(b, "B", seed);
        other.join();
        CHECK(live.wait().exit == 0);
        fingerprints.push_back(live.fingerprint());
        CHECK(live.replay().exit == 0);
    }
    CHECK(fingerprints[0] == fingerprints[1]);
    CHECK(fingerprints[0] == fingerprints[2]);
}

TEST_CASE("live: Ctrl-C ends the run within a second, with results and end messages") {
    const Live live({"--listen-json", "127.0.0.1:0"});
    LineClient client(live.port());
    client.ask(hello("\"A\""));
    client.ask(R"({"type":"step","n":1,"do":{"A":{"v":1}}})");
    live.process().interrupt();
    const Json end = Json::parse(client.line());
    CHECK(end.at("reason") == "stopped");
    CHECK(live.wait().exit == 0);
    CHECK(live.fingerprint() == end.at("fingerprint").get<std::string>());
    CHECK(live.replay().exit == 0);
    CHECK(Json::parse(content(live.folder.path("out/summary.json"))).at("sim_s") == 0.1);
}

TEST_CASE(
    "live: a lost controller, a slow controller or a failed controller program ends the run with "
    "code 1") {
    const Live lost({"--listen-json", "127.0.0.1:0"});
    {
        LineClient client(lost.port());
        client.ask(hello("\"A\""));
        client.reset();
    }
    const Ended without = lost.wait();
    CHECK(without.exit == 1);
    CHECK(without.err.find(
              "controller A has disconnected at 0 s without a message of type \"bye\"") !=
          std::string::npos);
    CHECK(lost.replay().exit == 0);

    const Live slow({"--listen-json", "127.0.0.1:0", "--patience", "50ms"});
    LineClient client(slow.port());
    client.ask(hello("\"A\""));
    CHECK(Json::parse(client.line()).at("reason") == "patience");
    CHECK(slow.wait().err.find("no request within 0.05 s from controller A") != std::string::npos);

    for (const std::string program : {"sleep 30", "yes"}) {
        const Live silent({"--controller", program, "--patience", "50ms"});
        const Ended ended = silent.wait();
        CHECK(ended.exit == 1);
        CHECK(ended.err.find("no message of type \"hello\" within 0.05 s from controller \"" +
                             program + "\"") != std::string::npos);
    }

    const Live failing({"--controller", "exit 7"});
    const Ended failed = failing.wait();
    CHECK(failed.exit == 1);
    CHECK(failed.err.find("exit 7 ended with exit code 7") != std::string::npos);
}

TEST_CASE("live: if a program ends before its hello, the results of an earlier run remain") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", live_row), out = folder.path("out");
    CHECK(command(folder, {"run", file, "--out", out}).exit == 0);
    const std::string summary = content(out + "/summary.json");
    const Ended failed = command(folder, {"live", file, "--out", out, "--controller", "exit 7"});
    CHECK(failed.exit == 1);
    CHECK(failed.err.find("exit 7 ended with exit code 7") != std::string::npos);
    CHECK(content(out + "/summary.json") == summary);
    CHECK_FALSE(std::filesystem::exists(out + "/inputs.jsonl"));

    // Its own input also remains, in a folder without results.
    std::filesystem::remove(out + "/summary.json");
    const std::string scenario = out + "/scenario.toml", text = content(scenario);
    CHECK(command(folder, {"live", scenario, "--out", out, "--controller", "exit 7"}).exit == 1);
    CHECK(content(scenario) == text);
}

TEST_CASE(
    "live: a client may send lines before it gets answers, and gets all answers after it stops "
    "sending") {
    const Live live({"--listen-json", "127.0.0.1:0"});
    LineClient client(live.port());
    client.send_bytes(hello("\"A\"") + "\n" + R"({"type":"step","n":1})" + "\r\n" +
                      R"({"type":"step","n":2})" + "\n" + R"({"type":"bye"})" + "\n");
    client.end_sending();
    std::vector<std::string> types;
    for (std::string line = client.line(); !line.empty(); line = client.line()) {
        types.push_back(Json::parse(line).at("type"));
    }
    CHECK(types == std::vector<std::string>{"welcome", "state", "state", "end"});
    CHECK(live.wait().exit == 0);
}

TEST_CASE("live: only this machine can connect, and an address in use is reported") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", live_row);
    const auto refused = [&](const std::string& address) {
        const Ended ended = command(folder, {"live", file, "--listen-json", address});
        CAPTURE(address);
        CHECK(ended.exit == 2);
        return ended.err;
    };
    CHECK(refused("0.0.0.0:0").find("expected an address that only this machine can reach") !=
          std::string::npos);
    for (const char* address : {"192.168.1.1:7007", "127.0.0.1", "127.0.0.1:x", "127.0.0.1:65536",
                                "[::]:7007", "example.org:1", ":7007"}) {
        refused(address);
    }
    CHECK(command(folder, {"live", file}).exit == 2);
    CHECK(command(folder, {"live", file, "--unix", file}).exit == 1);
    const Live live({"--listen-json", "127.0.0.1:0"});
    CHECK(
        command(folder, {"live", file, "--listen-json", "127.0.0.1:" + std::to_string(live.port())})
            .exit == 1);
    live.process().interrupt();
    CHECK(live.wait().exit == 0);
}

TEST_CASE("live: hostile clients are disconnected, take little memory and delay nobody") {
    const Live live({"--listen-json", "127.0.0.1:0"});
    const int port = live.port();
    LineClient good(port);
    good.ask(hello("\"A\""));

    LineClient endless(port);
    const std::string megabyte(std::size_t{1} << 20U, 'x');
    endless.send_bytes("{" + megabyte);
    endless.send_bytes(megabyte);
    CHECK(Json::parse(endless.line()).at("code") == "too_long");
    CHECK(endless.line().empty());
    CHECK(Json::parse(good.ask(R"({"type":"step","n":1})")).at("n") == 1);

    // Somebody who asks and never reads is not read any more.
    LineClient deaf(port);
    std::string questions = "{}\n";
    for (int i = 0; i < 20'000; ++i) questions += "nonsense\n";
    std::thread asks([&] {
        for (int i = 0; i < 100; ++i) {
            if (!deaf.send_bytes(questions)) return;
        }
    });
    for (int n = 2; n <= 10; ++n) {
        std::this_thread::sleep_for(20ms);
        const std::string step = R"({"type":"step","n":)" + std::to_string(n) + "}";
        CHECK(Json::parse(good.ask(step)).at("n") == n);
    }
    CHECK(megabytes_of(live.process().pid()) < 256);

    // The one beyond the limit is closed at once, and those who drop out free their places.
    std::vector<LineClient> crowd;
    for (int i = 0; i < 498; ++i) {
        const std::string answer = crowd.emplace_back(port).ask("{}");
        CHECK(Json::parse(answer).at("type") == "error");
    }
    LineClient beyond(port);
    CHECK(beyond.line().empty());
    for (auto& each : crowd) each.reset();
    CHECK(Json::parse(good.ask(R"({"type":"step","n":11})")).at("n") == 11);
    LineClient late(port);
    CHECK(Json::parse(late.ask("[]")).at("code") == "bad_json");

    good.send_bytes("{\"type\":\"bye\"}\n");
    CHECK(Json::parse(good.line()).at("type") == "end");
    CHECK(live.wait().exit == 0);
    asks.join();
}

namespace {

/// One round of a client: it writes twice, as libplayerc does. @return the x of position2d
double round(LineClient& client) {
    client.send_bytes(rovernet::test::drive(1, 0));
    client.send_bytes(ask());
    CHECK(message_of(client).type == ack);
    const Wire told = message_of(client);
    CHECK(told.interface == 4);
    CHECK(message_of(client).type == sync_message);
    return double_at(told.payload, 0);
}

}  // namespace

TEST_CASE("live: a Player client in lock-step does not wait for delayed TCP acknowledgements") {
    std::string fingerprints[2];
    for (std::string& fingerprint : fingerprints) {
        const Live live({"--player", "127.0.0.1:0", "--player-lockstep"}, long_live_row());
        LineClient client(live.port());
        open_position(client);
        std::vector<double> took;
        for (int i = 1; i <= 200; ++i) {
            const auto before = std::chrono::steady_clock::now();
            CHECK(std::abs(round(client) - 0.1 * i) < 1e-9);
            took.push_back(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
        }
        client.close();
        const Ended ended = live.wait();
        CHECK(ended.exit == 0);
        CHECK(Json::parse(content(live.folder.path("out/summary.json"))).at("sim_s") == 20);
        fingerprint = live.fingerprint();
        CHECK(live.replay().out.find("identical: 201 inputs, fingerprint " + fingerprint) !=
              std::string::npos);
        // With Nagle's algorithm at the client, each waits 40 ms for a delayed acknowledgement.
        std::nth_element(took.begin(), took.begin() + 100, took.end());
        CHECK(took[100] < 0.005);
    }
    CHECK(fingerprints[0] == fingerprints[1]);
}

TEST_CASE("live: Player clients of a paced run are served until Ctrl-C or the scenario's end") {
    const Live live({"--player", "127.0.0.1:0", "--speed", "5"}, long_live_row());
    CHECK(live.said("listening").ends_with("(Player, robot A)"));
    LineClient client(live.port());
    open_position(client);
    double last = round(client);
    for (int i = 0; i < 5; ++i) {
        const double x = round(client);
        CHECK(x > last);
        last = x;
    }
    live.process().interrupt();
    CHECK(live.wait().exit == 0);
    CHECK(live.replay().exit == 0);
    CHECK(client.bytes(1).empty());

    const Live short_run({"--player", "127.0.0.1:0", "--player-one-port", "--speed", "20"});
    LineClient second(short_run.port());
    open_position(second);
    CHECK(short_run.wait().exit == 0);
    CHECK(Json::parse(content(short_run.folder.path("out/summary.json"))).at("sim_s") == 2);
    CHECK(short_run.replay().exit == 0);
}

TEST_CASE(
    "live: ROS and Player clients are served together until Ctrl-C; a web page needs the token") {
    const Live live({"--rosbridge", "127.0.0.1:0", "--player", "127.0.0.1:0"}, long_live_row());
    LineClient player(live.port());
    open_position(player);
    round(player);
    const int port = read_port(live.said("listening on 127.0.0.1:", "(rosbridge)"));
    WebClient client(port), silent(port);
    CHECK(WebClient(port, "Origin: null\r\n").answer().starts_with("HTTP/1.1 403 "));
    const std::string told = live.said("for a page: "), token = told.substr(told.find("/?token="));
    CHECK(WebClient(port, "Origin: null\r\n", token).is_in());
    const auto publish = [&](const std::string& topic) {
        client.send(R"({"op":"publish","id":"x","msg":{},"topic":")" + topic + R"("})");
        client.send(R"({"op":"call_service","id":"y","service":"rosapi/get_time"})");
        return client.message();
    };
    CHECK(publish("/B/cmd_vel").find(R"("id":"y")") != std::string::npos);
    CHECK(publish("/A/cmd_vel").find("robot A is driven by another program") != std::string::npos);
    // While it waits for the goodbye of the silent one, nobody is listened to any more.
    std::thread talk([&] {
        while (player.send_bytes(ask())) std::this_thread::sleep_for(1ms);
    });
    live.process().interrupt();
    CHECK(client.reason() == 1001);
    CHECK(live.wait().exit == 0);
    talk.join();
    CHECK(live.replay().exit == 0);

    const TemporaryFolder folder;
    const auto error = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"live", folder.write("row.toml", live_row)};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = command(folder, words);
        CHECK(ended.exit == 2);
        return ended.err;
    };
    CHECK(error({"--listen-json", "127.0.0.1:0", "--speed", "2"})
              .find("--speed needs --player, --rosbridge or --view") != std::string::npos);
    CHECK(error({"--rosbridge", "0.0.0.0:9090"}).find("an address that only this machine") !=
          std::string::npos);
}

TEST_CASE(
    "live: a controller beside Player and ROS clients controls time, and its reset restarts the "
    "run") {
    const Live live({"--listen-json", "127.0.0.1:0", "--player", "127.0.0.1:0", "--rosbridge",
                     "127.0.0.1:0", "--speed", "10"},
                    long_live_row());
    LineClient player(live.port("(Player, robot A)")), controller(live.port());
    WebClient page(live.port("(rosbridge)"));
    const auto time = [&](WebClient& client) {
        client.send(R"({"op":"call_service","service":"rosapi/get_time"})");
        const Json answer = Json::parse(client.message()).at("values").at("time");
        return answer.at("sec").get<double>() + 1e-9 * answer.at("nanosec").get<double>();
    };
    open_position(player);
    player.send_bytes(ask());
    CHECK(message_of(player).type == ack);
    CHECK(time(page) == 0);
    CHECK(Json::parse(controller.ask(hello(R"("A","B")"))).at("type") == "welcome");
    // A second controller finds that the page drives robot C.
    page.send(R"({"op":"publish","topic":"/C/cmd_vel","msg":{"linear":{"x":1}}})");
    std::this_thread::sleep_for(50ms);
    CHECK(time(page) == 0);
    CHECK(Json::parse(LineClient(live.port()).ask(hello("\"C\""))).at("code") == "taken");
    CHECK(Json::parse(controller.ask(R"({"type":"step","n":1,"do":{"A":{"v":1}}})")).at("t_ns") ==
          100'000'000);
    CHECK(double_at(message_of(player).payload, 0) == doctest::Approx(0.1));
    CHECK(message_of(player).type == sync_message);
    std::this_thread::sleep_for(50ms);
    CHECK(time(page) == doctest::Approx(0.1));

    controller.send_bytes("{\"type\":\"reset\"}\n");
    CHECK(Json::parse(controller.line()).at("t_ns") == 0);
    CHECK(player.bytes(1).empty());
    CHECK(page.reason() == 1000);
    WebClient again(live.port("(rosbridge)"));
    CHECK(time(again) == 0);
    again.send(R"({"op":"publish","topic":"/C/cmd_vel","msg":{"linear":{"x":1}}})");
    CHECK(time(again) == 0);
    CHECK(Json::parse(controller.ask(R"({"type":"step","n":1})")).at("t_ns") == 100'000'000);
    CHECK(Json::parse(controller.ask(R"({"type":"bye"})")).at("reason") == "bye");
    CHECK(again.reason() == 1001);
    CHECK(live.wait().exit == 0);
    CHECK(live.replay().out.starts_with("identical: 3 inputs"));
}

TEST_CASE("live: the world and the ports are read from a Player configuration file") {
    const TemporaryFolder folder;
    folder.write("two.world", R"(quit_time 1
position ( name "r0" pose [0 0 0] wifi ( model "friis" ) )
position ( name "r1" pose [9 0 0] wifi ( model "friis" ) )
)");
    const auto file = [&](const std::string& model) {
        return folder.write("two.cfg", R"(
driver ( name "stage" plugin "stageplugin" provides [ "simulation:0" ] worldfile "two.world" )
driver ( name "stage" provides [ "6666:position2d:0" "6666:wifi:0" ] model ")" +
                                           model + R"(" )
driver ( name "relay" provides [ "6666:opaque:0" ] )
)");
    };
    const std::string out = folder.path("out");
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--out", out});
        return command(folder, std::move(words));
    };
    const Ended ended = run({"live", file("r1"), "--player", "127.0.0.1:0", "--speed", "20"});
    CHECK(ended.exit == 0);
    CHECK(ended.out.find("(Player, robot r1)") != std::string::npos);
    CHECK(ended.out.find("robot r0)") == std::string::npos);
    const Ended missing = run({"live", file("r9"), "--player", "127.0.0.1:0"});
    CHECK(missing.exit != 0);
    CHECK(missing.err.find("two.cfg:3") != std::string::npos);
    CHECK(run({"live", file("r1"), "--speed", "2"}).exit == 2);
    CHECK(run({"live", file("r1"), "--player", "0.0.0.0:6665"}).exit == 2);
}

TEST_CASE(
    "live: with --json, standard output is one JSON document; addresses are printed on standard "
    "error") {
    const TemporaryFolder folder;
    const std::string file = folder.write("s.toml", live_row);
    const std::string any = "127.0.0.1:0", out = folder.path("out");
    const std::vector<std::vector<std::string>> commands = {
        {"live", file, "--out", out, "--listen-json", any, "--listen-web", any, "--unix",
         folder.path("socket")},
        {"live", file, "--out", out, "--player", any, "--rosbridge", any},
        {"emulate", file, "--out", out, "--udp", any, "--player", any, "--rosbridge", any},
    };
    for (std::vector<std::string> words : commands) {
        CAPTURE(words[4]);
        words.emplace_back("--json");
        const Process process(folder, words);
        for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(5ms)) {
            if (content(folder.path("stderr")).find("listening on ") != std::string::npos) break;
        }
        std::this_thread::sleep_for(100ms);
        process.interrupt();
        const Ended ended = process.wait();
        CAPTURE(ended.out);
        CHECK(ended.exit == 0);
        CHECK(Json::accept(ended.out));
        CHECK(Json::parse(ended.out, nullptr, false).contains("fingerprint"));
        CHECK(ended.err.find("listening on ") != std::string::npos);
        CHECK(ended.out.find("listening on ") == std::string::npos);
    }
}

}  // namespace live_test
