// SPDX-License-Identifier: MIT
// The command `emulate` with listeners for Player and for ROS beside the packets of programs.
#include "test/live/emulate/datagrams.hpp"
#include "test/live/emulate/emulation.hpp"
#include "test/live/live_command.hpp"
#include "test/live/web_client.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <string>

namespace beside_test {
using namespace rovernet::test;
using namespace std::chrono_literals;
using namespace std::string_literals;

namespace {

const std::string three = R"([scenario]
name = "beside"
duration = "60 s"
[propagation]
model = "friis"
[[robot]]
name = "A"
at = ["0 m", "0 m"]
[[robot]]
name = "B"
at = ["15 m", "0 m"]
[[robot]]
name = "C"
at = ["30 m", "0 m"]
)";

const std::string to_all = "RN\x01\x00\xff\xff\xff\xff"s;

}  // namespace

TEST_CASE(
    "emulate: Player and ROS clients drive robots while programs send packets over the robots' "
    "radios") {
    Emulation emulation(three, {"--udp", "127.0.0.1:0", "--player", "127.0.0.1:0", "--rosbridge",
                                "127.0.0.1:0", "--late", "60 s"});
    const auto port = [&](const std::string& what) { return emulation.port(7, what); };
    LineClient player(port("(Player, robot A)"));
    open_position(player);
    player.send_bytes(drive(0.5, 0.1));
    WebClient ros(port("(rosbridge)"));
    ros.send(R"({"op":"publish","topic":"/B/cmd_vel","msg":{"linear":{"x":-0.5}}})");
    ros.send(R"({"op":"subscribe","topic":"/B/radio/received"})");
    ros.ask(R"({"op":"call_service","service":"rosapi/get_time"})");

    const Datagrams a(port("(robot A)")), b(port("(robot B)"));
    b.send("who I am");  // the port answers to whoever has spoken last
    a.send(to_all + "hello");
    CHECK(b.next(20s).substr(12) == "hello");
    CHECK(Json::parse(ros.message()).at("msg").at("data") == "aGVsbG8=");  // B hears it once
    ros.send(R"({"op":"publish","topic":"/B/radio/send","msg":{"data":"Rg=="}})");
    CHECK(a.next(20s).substr(12) == "F");

    CHECK(emulation.stop().exit == 0);
    const std::string log = content(emulation.folder.path("out/inputs.jsonl"));
    for (const char* input :
         {R"("client":"player","robot":"A","do":{"v":)", R"("robot":"B","do":{"v":)",
          R"("client":"rosbridge","robot":"B","do":{"to":)",
          R"("client":"programs","robot":"A","do":{"to":)"}) {
        CAPTURE(input);
        CHECK(log.find(input) != std::string::npos);
    }
    const std::string fingerprint = emulation.summary().at("fingerprint");
    const Ended replayed = emulation.replay();
    CHECK(replayed.out.starts_with("identical: "));
    CHECK(replayed.out.ends_with("fingerprint " + fingerprint + "\n"));
}

}  // namespace beside_test
