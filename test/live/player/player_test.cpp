// SPDX-License-Identifier: MIT
// The Player server without sockets: against what the original said to real clients (captures in
// test/data/player), and against the geometry of what it tells.
#include "live/input_replay.hpp"
#include "live/player/front.hpp"
#include "test/live/player/player_talk.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <regex>
#include <string>
#include <vector>

namespace player_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// Robots 1 m apart whose radios are such that the link has the values of a link table that was
/// worked out by hand: level -39 dBm, noise -95 dBm, quality 56.
const std::string pair = R"([scenario]
duration = "60 s"
[propagation]
model = "friis"
[radio]
power = "1.2251 dBm"
sensitivity = "-67 dBm"
noise_figure = "6 dB"
essid = "test network"
[[robot]]
name = "robot1"
at = ["-3 m", "0 m"]
scan = { kind = "ranger", range = "5 m" }
[[robot]]
name = "robot2"
at = ["-3 m", "1 m"]
radio = { ip = "192.168.0.4", mac = "08:00:20:ae:fd:6b" }
)";

/// A message of a capture, and who sent it.
struct Captured {
    bool by_client;
    Wire message;
};

/// Lines of hexadecimal bytes, as they were carried.
std::vector<Captured> raw_capture(const std::string& name) {
    std::ifstream file(ROVERNET_TEST_DATA "/player/" + name);
    std::vector<Captured> all;
    std::string direction, size, hex;
    while (file >> direction >> size >> hex) {
        std::string bytes = from_hex(hex);
        if (size == "32") continue;  // the banner
        for (Wire& each : take_messages(bytes)) all.push_back({direction == "C>S", each});
    }
    return all;
}

/// Lines of decoded headers and hexadecimal payloads.
std::vector<Captured> decoded_capture(const std::string& name) {
    static const std::regex line_of(
        R"((C>S|S>C) host (\w+) robot (\d+) if (\d+):(\d+) (\w+) sub (\d+) ts \S+ seq \d+ size (\d+) \| ?(\w*).*)");
    static const std::vector<std::string> types = {"",    "DATA",  "CMD", "REQ",
                                                   "ACK", "SYNCH", "NACK"};
    std::ifstream file(ROVERNET_TEST_DATA "/player/" + name);
    std::vector<Captured> all;
    std::smatch part;
    for (std::string line; std::getline(file, line);) {
        if (!std::regex_match(line, part, line_of)) continue;
        const auto number = [&](std::size_t i, int base = 10) {
            return static_cast<std::uint32_t>(std::stoul(part[i], nullptr, base));
        };
        const auto type = std::find(types.begin(), types.end(), part[6]) - types.begin();
        Wire message{number(2, 16),
                     number(3),
                     number(4),
                     number(5),
                     static_cast<std::uint32_t>(type),
                     number(7),
                     0,
                     0,
                     from_hex(std::string(part[9]))};
        message.payload.resize(number(8));  // long ones are cut
        all.push_back({part[1] == "C>S", message});
    }
    return all;
}

/// What this server says where the original said the same of its own drivers.
Wire with_own_names(Wire message) {
    for (const char* name : {"stage", "relay"}) {
        const std::string theirs = counted(std::string(name) + '\0');
        const auto at = message.payload.find(theirs);
        if (at == std::string::npos) continue;
        message.payload.replace(at, theirs.size(), counted(std::string("rovernet") + '\0'));
    }
    return message;
}

/// Has the client of a capture speak, and returns the answers of both servers but for data.
struct Answers {
    std::vector<Wire> theirs, ours;
};
Answers answers(PlayerTalk& talk, const std::vector<Captured>& capture) {
    const auto client = talk.come();
    Answers all;
    for (const auto& [by_client, message] : capture) {
        if (!by_client) {
            if (message.type != data) all.theirs.push_back(with_own_names(message));
            continue;
        }
        talk.say(client, message.bytes());
        talk.run_for(100ms);
        for (Wire& each : talk.told(client)) {
            if (each.type != data) all.ours.push_back(each);
        }
    }
    return all;
}

/// Whether a payload may differ from the original's: a list with one device more, memory that
/// leaked, and the ranger, which has other dimensions.
bool is_own(const Wire& message) {
    return message.type == ack &&
           ((message.interface == 1 && message.subtype == 1) ||
            (message.interface == 4 && message.subtype == 1) || message.interface == 62);
}

void check_same(const Answers& all) {
    REQUIRE(all.ours.size() == all.theirs.size());
    for (std::size_t i = 0; i < all.ours.size(); ++i) {
        CAPTURE(i);
        Wire ours = all.ours[i], theirs = all.theirs[i];
        if (is_own(theirs)) {
            if (theirs.interface != 1) CHECK(ours.payload.size() == theirs.payload.size());
            ours.payload = theirs.payload = {};
        }
        CHECK(ours.gist() == theirs.gist());
    }
}

/// Whether each element of a list of devices is in another one, in that order.
void check_devices(const std::string& theirs, const std::string& ours) {
    std::size_t at = 8;
    for (std::size_t i = 8; i < theirs.size(); i += 16) {
        at = ours.find(theirs.substr(i, 16), at);
        REQUIRE(at != std::string::npos);
    }
}

std::vector<Wire> data_of(const std::vector<Wire>& all, std::uint32_t interface,
                          std::uint32_t index = 0) {
    std::vector<Wire> found;
    for (const Wire& each : all) {
        if (each.type == data && each.interface == interface && each.index == index) {
            found.push_back(each);
        }
    }
    return found;
}

std::string types(const std::vector<Wire>& all) {
    std::string text;
    for (const Wire& each : all) text += "?DCRASN"[each.type];
    return text;
}

}  // namespace

TEST_CASE(
    "player: a recorded client that asks for links gets the same answers as from the original "
    "Player") {
    PlayerTalk talk(player_scenario(pair));
    const auto capture = raw_capture("links_pull.log");
    REQUIRE(capture.size() > 25);
    const Answers all = answers(talk, capture);
    // The original's rounds were cut off before their SYNCH in this capture.
    Answers without_synch;
    for (const Wire& each : all.ours) {
        if (each.type != sync_message) without_synch.ours.push_back(each);
    }
    for (const Wire& each : all.theirs) {
        if (each.type != sync_message) without_synch.theirs.push_back(each);
    }
    check_same(without_synch);
    check_devices(without_synch.theirs[1].payload, without_synch.ours[1].payload);
}

TEST_CASE(
    "player: a recorded client that drives a robot gets the same answers as from the original "
    "Player") {
    PlayerTalk talk(player_scenario(pair));
    const auto capture = decoded_capture("drive_pull.log");
    REQUIRE(capture.size() > 80);
    Answers all = answers(talk, capture);
    REQUIRE_FALSE(all.theirs.empty());
    all.theirs.pop_back();  // its request is not in the capture
    CHECK(std::count_if(all.ours.begin(), all.ours.end(),
                        [](const Wire& each) { return each.type == sync_message; }) == 5);
    check_same(all);
    check_devices(all.theirs[1].payload, all.ours[1].payload);
    const auto geometry = std::find_if(all.ours.begin(), all.ours.end(), [](const Wire& each) {
        return each.interface == 4 && each.subtype == 1;
    });
    CHECK(geometry->payload == doubles({0, 0, 0, 0, 0, 0, 0.4, 0.4, 0.3}));
}

TEST_CASE(
    "player: a recorded client in PUSH mode gets the same answers as from the original Player") {
    PlayerTalk talk(player_scenario(pair));
    auto capture = decoded_capture("drive_push.log");
    for (Captured& each : capture) each.message.robot = each.by_client ? 0 : 6665;
    check_same(answers(talk, capture));
}

TEST_CASE("player: the banner has 32 bytes, and begins with \"Player v.\"") {
    CHECK(player_banner().size() == 32);
    CHECK(player_banner().starts_with("Player v."));
}

TEST_CASE(
    "player: data of position2d have the expected bytes; the pose may differ by less than 1e-15") {
    PlayerTalk talk(player_scenario(pair));
    const auto client = talk.come();
    const std::string sample =
        from_hex("3ff32729a6ca1b7b3fcf0f5cbe86e5cb3fda3d70a3d70a43") + std::string(28, '\0');
    talk.say(client, device(4, 0) + request(4, 0, 5, sample.substr(0, 24)));
    talk.run_for(100ms);
    const auto told = data_of(talk.told(client), 4);
    REQUIRE(told.size() == 1);
    // Odometry is the pose less its origin: the last digit may differ.
    for (const std::size_t at : {0U, 8U, 16U}) {
        CHECK(std::abs(double_at(told[0].payload, at) - double_at(sample, at)) < 1e-15);
    }
    CHECK(told[0].payload.substr(24) == sample.substr(24));
    CHECK(told[0].time == 0.1);
    CHECK(told[0].robot == 6665);
    CHECK(to_hex(told[0].bytes()).starts_with("0100007f00001a09"));
}

TEST_CASE("player: the link table of the device `wifi` has the expected bytes") {
    PlayerTalk talk(player_scenario(pair));
    const auto client = talk.come();
    talk.say(client, device(23, 0));
    talk.run_for(100ms);
    const auto told = data_of(talk.told(client), 23);
    REQUIRE(told.size() == 1);
    const std::string bit_rate = "00a7d8c0";  // 11 Mb/s; the sample had none
    CHECK(to_hex(told[0].payload) ==
          "0000000100000001000000110000001130383a30303a32303a61653a66643a36620000000000000b0000000b"
          "3139322e3136382e302e34000000000c0000000c74657374206e6574776f726b000000020000099200000000"
          "00000038ffffffd9ffffffa1"
          "00000000" +
              bit_rate + "000000020000000100000064" + std::string(80, '0'));
    CHECK(talk.ask(client, request(23, 0, 1))[0].payload == counted("02:00:00:00:00:01"));
    CHECK(types(talk.ask(client, request(23, 0, 2))) == "N");
}

TEST_CASE("player: a driven robot follows the commanded arc, in its odometry and in the world") {
    PlayerTalk talk(player_scenario(pair));
    const auto client = talk.come();
    talk.say(client, mode(pull) + device(4, 0) + device(31, 0) + drive(0.3, 0.1));
    talk.run_until(5s);
    talk.told(client);
    talk.say(client, ask());
    talk.run_for(100ms);
    const auto told = talk.told(client);
    CHECK(types(told) == "ADS");
    const double t = 5.1, angle = 0.1 * t, radius = 0.3 / 0.1;
    const std::string& pose = told[1].payload;
    CHECK(double_at(pose, 0) == doctest::Approx(radius * std::sin(angle)).epsilon(1e-3));
    CHECK(double_at(pose, 8) == doctest::Approx(radius * (1 - std::cos(angle))).epsilon(1e-3));
    CHECK(double_at(pose, 16) == doctest::Approx(angle).epsilon(1e-9));
    CHECK(double_at(pose, 24) == 0.3);
    CHECK(double_at(pose, 40) == 0.1);
    const auto world = talk.ask(
        client, request(31, 0, 1, counted(std::string("robot1\0", 7)) + doubles({0, 0, 0})));
    REQUIRE(types(world) == "A");
    CHECK(double_at(world[0].payload, 16) == doctest::Approx(double_at(pose, 0) - 3));
}

TEST_CASE("player: a client sets and resets the odometry, and places a robot elsewhere") {
    PlayerTalk talk(player_scenario(pair));
    const auto client = talk.come();
    const std::string name = counted(std::string("robot2\0", 7));
    talk.say(client, device(4, 0));
    CHECK(types(talk.ask(client, request(31, 0, 2, name + doubles({4, 5, 0.5})))) == "A");
    CHECK(talk.ask(client, request(31, 0, 1, name + doubles({0, 0, 0})))[0].payload ==
          name + doubles({4, 5, 0.5}));
    const auto other = talk.come(1);
    talk.say(other, device(4, 0));
    talk.run_for(100ms);
    const auto moved = data_of(talk.told(other), 4);
    REQUIRE(moved.size() == 1);
    CHECK(moved[0].payload == doubles({7, 4, 0.5, 0, 0, 0}) + be32(0));  // it was at (-3, 1)
    talk.ask(other, request(4, 0, 6));
    talk.run_for(100ms);
    CHECK(data_of(talk.told(other), 4)[0].payload == doubles({0, 0, 0, 0, 0, 0}) + be32(0));
    for (const double bad : {std::nan(""), 1e300, -HUGE_VAL}) {
        CHECK(types(talk.ask(client, request(31, 0, 2, name + doubles({bad, 0, 0})))) == "N");
        CHECK(types(talk.ask(other, request(4, 0, 5, doubles({0, bad, 0})))) == "N");
    }
}

TEST_CASE(
    "player: an unknown device is refused, and a message `SYNCH` is sent only together with data") {
    PlayerTalk talk(player_scenario(pair));
    const auto client = talk.come();
    const auto refused = talk.ask(client, mode(pull) + device(23, 9));
    REQUIRE(types(refused) == "AN");
    CHECK(to_hex(refused[1].payload) ==
          "0100007f00001a0900000017000000090000000300000000"
          "00000000");
    talk.say(client, ask());
    talk.run_for(1s);
    CHECK(types(talk.told(client)) == "A");
    talk.say(client, device(51, 0));
    talk.run_for(1s);
    CHECK(types(talk.told(client)) == "A");
    talk.say(client, order(51, 0,
                           counted(std::string("\x03"
                                               "F",
                                               2))));
    talk.run_for(100ms);
    const auto told = talk.told(client);
    REQUIRE(types(told) == "DS");
    CHECK(to_hex(told[0].payload) == "000000020000000203460000");
}

TEST_CASE(
    "player: a message to the relay reaches all clients of the robot, including the sender, and no "
    "others") {
    PlayerTalk talk(player_scenario(pair));
    const auto sender = talk.come(), listener = talk.come(), other = talk.come(1);
    for (const auto client : {sender, listener, other}) talk.say(client, device(51, 0));
    talk.say(sender, order(51, 0, counted("one")) + order(51, 0, counted("two")));
    talk.run_for(100ms);
    for (const auto client : {sender, listener}) {
        const auto told = data_of(talk.told(client), 51);
        REQUIRE(told.size() == 2);
        CHECK(told[0].payload == counted("one"));
        CHECK(told[1].payload == counted("two"));
    }
    CHECK(data_of(talk.told(other), 51).empty());
}

TEST_CASE("player: radio messages are received by the other robots in range") {
    PlayerTalk talk(player_scenario(pair));
    const auto sender = talk.come(0), hearer = talk.come(1);
    talk.say(sender, device(51, 1));
    talk.say(hearer, device(51, 1));
    talk.say(sender, order(51, 1,
                           counted(std::string("\x03"
                                               "F",
                                               2))));
    talk.run_for(100ms);
    const auto told = data_of(talk.told(hearer), 51, 1);
    REQUIRE(told.size() == 1);
    CHECK(told[0].payload == counted(std::string("\x03"
                                                 "F",
                                                 2)));
    CHECK(data_of(talk.told(sender), 51, 1).empty());
    CHECK(talk.session.network().metrics().messages == 1);
    talk.say(sender, order(51, 1, counted(std::string(65'536, 'x'))));
    talk.run_for(100ms);
    CHECK(talk.session.network().metrics().messages == 1);
}

TEST_CASE(
    "player: two clients of a robot both get data, and the robot stops only when both have left") {
    PlayerTalk talk(player_scenario(pair));
    const auto first = talk.come(), second = talk.come();
    talk.say(first, device(4, 0) + drive(1, 0));
    talk.say(second, device(4, 0));
    talk.run_for(1s);
    CHECK(data_of(talk.told(first), 4).size() == 10);
    CHECK(data_of(talk.told(second), 4).size() == 10);
    talk.go(first);
    talk.run_for(1s);
    const auto told = data_of(talk.told(second), 4);
    REQUIRE(told.size() == 10);
    CHECK(double_at(told.back().payload, 0) == doctest::Approx(2));
    talk.go(second);
    talk.run_for(1s);
    CHECK(talk.session.network().position(NodeId{0}).x == doctest::Approx(-1));
    CHECK_FALSE(talk.session.driver(NodeId{0}));
}

TEST_CASE(
    "player: a robot that no client drives moves as in the scenario, even if a client subscribes") {
    PlayerTalk talk(
        player_scenario(pair + "move = { model = \"goal\", to = [\"7 m\", \"1 m\"] }\n"));
    const auto client = talk.come(1);
    talk.say(client, device(4, 0) + device(51, 1));
    talk.run_for(2s);
    CHECK(double_at(data_of(talk.told(client), 4).back().payload, 0) == doctest::Approx(2));
    talk.go(client);
    talk.run_for(2s);
    CHECK(talk.session.network().position(NodeId{1}).x == doctest::Approx(1));
}

TEST_CASE(
    "player: a client in PULL mode gets only the newest data, the last 1,023 messages, and the "
    "number of lost messages") {
    PlayerTalk talk(player_scenario(pair));
    const auto client = talk.come();
    talk.say(client, mode(pull) + device(4, 0) + device(51, 0));
    talk.run_for(500ms);
    for (int i = 0; i < 1030; ++i) {
        talk.say(client, order(51, 0, counted(std::to_string(i))));
        if (i % 500 == 0) talk.run_for(100ms);
    }
    talk.run_for(100ms);
    talk.told(client);
    talk.say(client, ask());
    talk.run_for(1s);
    const auto told = talk.told(client);
    CHECK(told[0].type == ack);
    CHECK(told[1].type == sync_message);  // there were more than it is kept for
    CHECK(told[1].subtype == 2);
    CHECK(number_at(told[1].payload, 0, 4) == 7);
    CHECK(data_of(told, 4).size() == 1);
    CHECK(data_of(told, 51).size() == 1023);
    CHECK(data_of(told, 51).back().payload == counted("1029"));
    CHECK(told.back().type == sync_message);
    CHECK(told.back().subtype == 1);
    CHECK(told.back().host == 0);
    CHECK(told.back().time == 0);
}

TEST_CASE("player: range finders measure only for subscribers, and no distance is negative") {
    const std::string in_a_wall = R"([scenario]
duration = "60 s"
[[robot]]
name = "robot1"
at = ["0 m", "0 m"]
heading = "90 deg"
scan = { kind = "KIND", beams = 5, range = "3 m", every = "250 ms" }
[[robot]]
name = "robot2"
at = ["0 m", "AWAY"]
)";
    const auto with = [&](const std::string& kind, const std::string& away) {
        std::string text = in_a_wall;
        text.replace(text.find("KIND"), 4, kind);
        text.replace(text.find("AWAY"), 4, away);
        return player_scenario(text);
    };
    for (const auto& [kind, interface] : {std::pair{"laser", 6U}, {"sonar", 5U}, {"ranger", 62U}}) {
        PlayerTalk talk(with(kind, "2 m"));
        const auto client = talk.come();
        talk.say(client, device(interface, 0));
        talk.run_for(1s);
        const auto told = data_of(talk.told(client), interface);
        REQUIRE(told.size() == 4);
        CHECK(told[1].time == 0.5);
        const std::string& payload = told[0].payload;
        if (interface == 62) {
            CHECK(payload.substr(0, 24) == be32(5) + be32(5) + doubles({3, 3}));
            CHECK(std::abs(double_at(payload, 24) - 1.8) < 1e-12);
            CHECK(payload.substr(32) == doubles({3, 3}));
        } else {
            const std::size_t at = interface == 6 ? 24 : 8;
            CHECK(payload.size() == at + 20 + (interface == 6 ? 12 : 0));
            CHECK(float_at(payload, at) == 3);
            CHECK(float_at(payload, at + 8) == 1.8F);
        }
        CHECK(types(talk.ask(client, request(interface, 0, 1))) == "A");
    }
    PlayerTalk inside(with("laser", "0 m"));
    const auto client = inside.come();
    inside.say(client, device(6, 0));
    inside.run_for(250ms);
    const auto told = data_of(inside.told(client), 6);
    REQUIRE(told.size() == 1);
    CHECK(float_at(told[0].payload, 0) == static_cast<float>(-std::numbers::pi / 2));
    CHECK(float_at(told[0].payload, 8) == static_cast<float>(std::numbers::pi / 4));
    CHECK(float_at(told[0].payload, 12) == 3);
    for (std::size_t i = 0; i < 5; ++i) CHECK(float_at(told[0].payload, 24 + 4 * i) == 0);
    const auto config = inside.ask(client, request(6, 0, 3));
    REQUIRE(config.size() == 1);
    CHECK(config[0].payload.size() == 28);
    CHECK(float_at(config[0].payload, 24) == 4);
}

TEST_CASE("player: robots at one port have different device indices") {
    PlayerTalk talk(player_scenario(pair), {.places = {{"robot1", 0, 0}, {"robot2", 0, 1}}});
    const auto client = talk.come();
    const auto list = talk.ask(client, request(1, 0, 1));
    CHECK(number_at(list[0].payload, 0, 4) == 10);
    talk.say(client, device(4, 1) + order(4, 1, doubles({1, 0, 0}) + be32(1)) + device(51, 3) +
                         device(51, 1) + order(51, 1, counted("hi")));
    talk.run_for(1s);
    const auto told = talk.told(client);
    CHECK(data_of(told, 4, 0).empty());
    CHECK(double_at(data_of(told, 4, 1).back().payload, 0) == doctest::Approx(1));
    CHECK(data_of(told, 51, 3).size() == 1);
}

TEST_CASE("player: in lock-step, time waits for all PULL clients, and runs are reproducible") {
    const auto run = [](bool swapped) {
        PlayerTalk talk(player_scenario(pair), {.is_lockstep = true, .wait_for = 2});
        const auto a = talk.come(0), b = talk.come(1);
        talk.run_for(10s);
        CHECK(talk.session.network().now() == start_of_run);
        const std::string begin = mode(pull) + device(4, 0) + device(51, 1);
        std::string told;
        talk.say(a, begin);
        talk.run_for(10s);
        CHECK(talk.session.network().now() == start_of_run);
        talk.say(b, begin);
        for (int n = 0; n < 20; ++n) {
            const std::string words = drive(0.1 * n, 0.2) + order(51, 1, counted("hello")) + ask();
            talk.say(swapped ? b : a, words);
            talk.run_for(10s);
            CHECK(talk.session.network().now() == start_of_run + n * 100ms);
            talk.say(swapped ? a : b, words);
            talk.run_for(10s);
            CHECK(talk.session.network().now() == start_of_run + (n + 1) * 100ms);
            for (const auto client : {a, b}) {
                for (const Wire& each : talk.told(client)) told += each.bytes();
            }
        }
        CHECK_FALSE(talk.front.is_done());
        talk.go(a);
        talk.go(b);
        CHECK(talk.front.is_done());
        return told + talk.fingerprint->text();
    };
    const std::string once = run(false);
    CHECK(once == run(false));
    CHECK(once == run(true));
}

TEST_CASE("player: in lock-step, a client that leaves cancels its commands") {
    PlayerTalk talk(player_scenario(pair), {.is_lockstep = true});
    const auto a = talk.come(0), b = talk.come(1);
    for (const auto client : {a, b}) talk.say(client, mode(pull) + device(4, 0));
    talk.say(a, drive(1, 0));
    talk.go(a);
    talk.say(b, drive(0, 1) + device(4, 0, 2) + device(4, 0) + ask());
    talk.run_for(10s);
    CHECK(talk.session.network().now() == start_of_run + 100ms);
    CHECK(talk.session.network().position(NodeId{0}) == Vec3{-3, 0, 0});
    CHECK(talk.session.network().heading(NodeId{1}).value == 0);
}

TEST_CASE("player: malformed messages are refused or end their connection without other effect") {
    PlayerTalk talk(player_scenario(pair));
    const auto bystander = talk.come();
    talk.say(bystander, device(4, 0));
    struct Case {
        std::string what, bytes, answers;
        bool closes = false;
    };
    std::string too_long = request(1, 0, 1);
    too_long.replace(36, 4, be32(0x100001));
    std::string huge = request(1, 0, 1);
    huge.replace(36, 4, be32(0xFFFFFFFF));
    const std::string name = std::string("robot1\0", 7);
    const std::vector<Case> cases = {
        {"a payload that is too long", too_long, "", true},
        {"one of 4 GiB", huge, "", true},
        {"text", std::string(80, 'x'), "", true},
        {"half a header", request(1, 0, 1).substr(0, 20), ""},
        {"half a payload", device(4, 0).substr(0, 60), ""},
        {"an unknown type", Wire{0, 0, 1, 0, 99, 1}.bytes(), ""},
        {"a type of servers", Wire{0, 0, 4, 0, ack, 1}.bytes(), ""},
        {"an unknown request", request(1, 0, 99), "N"},
        {"a login", request(1, 0, 7, counted("key")), "N"},
        {"a mode that is not there", request(1, 0, 5), "N"},
        {"an address that is cut", request(1, 0, 3, be32(0) + be32(0)), "N"},
        {"a device that is opened in another way", device(4, 0, 3), "N"},
        {"a driver of nothing", request(1, 0, 2, std::string(24, '\xFF')), "N"},
        {"a request to nothing", request(77, 0, 1), "N"},
        {"a number of device", request(4, 0xFFFFFFFF, 1), "N"},
        {"a name that is longer than the message",
         request(31, 0, 1, be32(0xFFFFFFFF) + be32(0xFFFFFFFF) + name), "N"},
        {"counts that differ", request(31, 0, 1, be32(7) + be32(8) + name + '\0'), "N"},
        {"a robot that is not there", request(31, 0, 1, counted("robot9") + doubles({0, 0, 0})),
         "N"},
        {"a place without a heading", request(31, 0, 2, counted(name) + doubles({0, 0})), "N"},
        {"half an odometry", request(4, 0, 5, doubles({1, 2})), "N"},
        {"a speed that is no number", drive(std::nan(""), 0), ""},
        {"a speed beyond all", drive(0, 1e9), ""},
        {"an empty command", order(4, 0, ""), ""},
        {"a command to nothing", order(77, 3, be32(0)), ""},
        {"a message of 4 GiB", order(51, 0, be32(0xFFFFFFFF) + be32(0xFFFFFFFF)), ""},
        {"an empty message", order(51, 1, ""), ""},
    };
    for (const Case& each : cases) {
        CAPTURE(each.what);
        const auto client = talk.come();
        const auto told = talk.ask(client, each.bytes);
        CHECK(types(told) == each.answers);
        CHECK(talk.closed.contains(client) == each.closes);
        if (!each.closes && each.answers != "") {
            CHECK(types(talk.ask(client, request(1, 0, 1))) == "A");
        }
        talk.go(client);
        talk.run_for(100ms);
        CHECK(data_of(talk.told(bystander), 4).size() == 1);
    }
    CHECK(talk.session.network().position(NodeId{0}) == Vec3{-3, 0, 0});
}

TEST_CASE("player: messages may arrive in pieces of any size") {
    const std::string words = mode(pull) + device(4, 0) + drive(1, 0) + ask();
    std::string whole;
    for (const std::size_t piece : {words.size(), std::size_t{1}, std::size_t{39}}) {
        PlayerTalk talk(player_scenario(pair));
        const auto client = talk.come();
        for (std::size_t i = 0; i < words.size(); i += piece) {
            talk.say(client, words.substr(i, piece));
        }
        talk.run_for(100ms);
        std::string told;
        for (const Wire& each : talk.told(client)) told += each.bytes();
        if (whole.empty()) whole = told;
        CHECK(told == whole);
    }
    CHECK_FALSE(whole.empty());
}

TEST_CASE("player: random bytes do not stop the server") {
    std::mt19937 bits(1);
    for (unsigned n = 0; n < 300; ++n) {
        PlayerTalk talk(player_scenario(pair));
        const auto client = talk.come();
        std::string words = mode(n % 2 + 1) + device(4, 0) + device(51, 0) + device(23, 0) +
                            drive(1, 1) + order(51, 0, counted("x")) +
                            request(31, 0, 1, counted("robot1") + doubles({0, 0, 0})) + ask();
        for (unsigned i = 0; i < 1 + n % 8; ++i) {
            words[bits() % words.size()] = static_cast<char>(bits());
        }
        talk.say(client, words);
        talk.run_for(300ms);
        talk.go(client);
    }
}

}  // namespace player_test
