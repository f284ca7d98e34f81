// SPDX-License-Identifier: MIT
// The rosbridge server without sockets: against what roslib said to a server (the capture in
// test/data/rosbridge), closed forms of motion and radio, and decoders of others.
#include "live/rosbridge/types.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/images/image.hpp"
#include "test/live/rosbridge/ros_talk.hpp"
#include "test/live/talk.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

namespace rosbridge_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

constexpr double exact = 1e-9;  // [m], [rad]: what the rounding of a few operations leaves
constexpr double chord = 1e-3;  // [m] of a driven robot from its arc, see Driven

Json twist(double v, double w) {
    return {{"linear", {{"x", v}, {"y", 0}, {"z", 0}}},
            {"angular", {{"x", 0}, {"y", 0}, {"z", w}}}};
}
double stamp(const Json& time) {
    return time["sec"].get<double>() + time["nanosec"].get<double>() / 1e9;
}
double heading(const Json& q) { return 2 * std::atan2(q["z"].get<double>(), q["w"].get<double>()); }

/// An office with a laser on A.
Scenario office() { return load_scenario(ROVERNET_EXAMPLES "/player/player.toml", {}); }

/// Numbers of a typed array that was read from CBOR.
template <class Number>
std::vector<Number> numbers(const Json& binary) {
    const auto& bytes = binary.get_binary();
    std::vector<Number> found(bytes.size() / sizeof(Number));
    std::memcpy(found.data(), bytes.data(), bytes.size());
    return found;
}

}  // namespace

TEST_CASE("rosbridge: cmd_vel drives a robot, and odometry and transforms give its pose") {
    RosTalk talk(three_in_a_row());
    talk.subscribe("/A/odom");
    talk.subscribe("tf");
    talk.publish("/A/cmd_vel", twist(0.5, 0));
    talk.run_until(1s);
    const Json straight = talk.messages("/A/odom").back();
    CHECK(stamp(straight["header"]["stamp"]) == 1);
    CHECK(straight["header"]["frame_id"] == "A/odom");
    CHECK(straight["child_frame_id"] == "A/base_link");
    CHECK(std::abs(straight["pose"]["pose"]["position"]["x"].get<double>() - 0.5) < exact);
    CHECK(straight["twist"]["twist"]["linear"]["x"] == 0.5);
    CHECK(straight["pose"]["covariance"].size() == 36);

    talk.publish("A/cmd_vel", {{"header", {{"frame_id", ""}}}, {"twist", twist(0.4, 0.8)}});
    talk.run_until(2s);
    Json odometry, transform;
    for (const Json& each : talk.told()) {
        if (each["topic"] == "/A/odom") odometry = each["msg"]["pose"]["pose"];
        if (each["topic"] == "tf") transform = each["msg"]["transforms"][0];
    }
    const Json position = odometry["position"];
    CHECK(std::abs(position["x"].get<double>() - (0.5 + 0.5 * std::sin(0.8))) < chord);
    CHECK(std::abs(position["y"].get<double>() - 0.5 * (1 - std::cos(0.8))) < chord);
    CHECK(transform["child_frame_id"] == "A/base_link");
    CHECK(transform["transform"]["translation"] == position);
    CHECK(transform["transform"]["rotation"] == odometry["orientation"]);

    talk.publish("A/cmd_vel", twist(0, -0.25));
    const double before = talk.session.network().heading({0}).value;
    talk.run_for(1s);
    CHECK(talk.session.network().now() == talk.session.end());
    CHECK(std::abs(talk.session.network().heading({0}).value - before) < exact);  // it is over
}

TEST_CASE("rosbridge: a robot turns in place at the commanded rate") {
    RosTalk talk(three_in_a_row());
    talk.subscribe("/A/odom");
    talk.publish("/A/cmd_vel", twist(0, -0.25));
    talk.run_until(1s);
    const Json pose = talk.messages("/A/odom").back();
    CHECK(std::abs(heading(pose["pose"]["pose"]["orientation"]) + 0.25) < exact);
    CHECK(std::abs(pose["twist"]["twist"]["angular"]["z"].get<double>() + 0.25) < exact);
}

TEST_CASE(
    "rosbridge: topics arrive at their rates in simulated time, under the names in the "
    "subscriptions") {
    RosTalk talk(three_in_a_row());
    for (const char* topic : {"/clock", "clock", "/tf", "/A/odom", "C/radio/neighbors"}) {
        talk.subscribe(topic);
    }
    talk.run_until(1s);
    std::map<std::string, int> count;
    for (const Json& each : talk.told()) ++count[each["topic"].get<std::string>()];
    const std::map<std::string, int> expected = {
        {"/clock", 100}, {"clock", 100}, {"/tf", 20}, {"/A/odom", 20}, {"C/radio/neighbors", 10}};
    CHECK(count == expected);
}

TEST_CASE(
    "rosbridge: with throttle_rate 100 a stream has exactly 10 messages a second, the newest "
    "ones") {
    for (const int queue_length : {0, 1}) {
        RosTalk talk(three_in_a_row());
        talk.subscribe("/clock", {{"throttle_rate", 100}, {"queue_length", queue_length}});
        talk.run_until(1s);
        const auto clocks = talk.messages("/clock");
        REQUIRE(clocks.size() == 10);
        for (std::size_t i = 0; i < clocks.size(); ++i) {
            CHECK(std::abs(stamp(clocks[i]["clock"]) - (0.01 + 0.1 * static_cast<double>(i))) <
                  exact);
        }
    }
}

TEST_CASE(
    "rosbridge: a throttled topic with a queue keeps the newest messages; without a queue, "
    "messages that come too early are dropped") {
    RosTalk talk(three_in_a_row());
    talk.subscribe("/B/radio/received", {{"throttle_rate", 500}, {"queue_length", 2}});
    talk.come(1);
    talk.say(R"({"op":"subscribe","topic":"/B/radio/received","throttle_rate":500})", 1);
    for (const char* data : {"MQ==", "Mg==", "Mw==", "NA=="}) {
        talk.publish("/C/radio/send", {{"data", data}});
    }
    talk.run_until(450ms);
    CHECK(talk.messages("/B/radio/received").size() == 1);
    talk.run_until(1500ms);
    const auto later = talk.messages("/B/radio/received");
    REQUIRE(later.size() == 2);
    CHECK(later[0]["data"] == "NA==");
    CHECK(later[1]["data"] == "dGljaw==");  // of the scenario's traffic, at 0.5 s
    CHECK(talk.messages("/B/radio/received", 1).size() == 2);
}

TEST_CASE("rosbridge: a queue keeps only the newest messages, at most 256 KiB") {
    RosStream stream;
    stream.add("1", {.interval = 1s, .queue_length = 1'000});
    std::vector<std::string> emitted;
    const auto emit = [&](std::string_view message) { emitted.emplace_back(message, 0, 3); };
    for (int i = 100; i < 900; ++i) {
        stream.take(std::to_string(i) + std::string(1'021, '.'), start_of_run, emit);
    }
    for (int s = 1; s <= 800; ++s) stream.go_on(start_of_run + s * 1s, emit);
    REQUIRE(emitted.size() == 1 + 256);
    CHECK(emitted[0] == "100");
    CHECK(emitted[1] == "644");
    CHECK(emitted.back() == "899");
    CHECK(stream.next() == never);
}

TEST_CASE("rosbridge: a client's subscriptions to one topic form one stream at the fastest rate") {
    RosTalk talk(three_in_a_row());
    talk.subscribe("/clock", {{"id", "slow"}, {"throttle_rate", 500}});
    talk.subscribe("/clock", {{"id", "fast"}, {"throttle_rate", 100}});
    talk.run_until(500ms);
    CHECK(talk.messages("/clock").size() == 5);
    talk.say(R"({"op":"unsubscribe","id":"fast","topic":"/clock"})");
    talk.run_until(1500ms);
    CHECK(talk.messages("/clock").size() <= 3);
    talk.say(R"({"op":"unsubscribe","topic":"/clock"})");
    talk.run_until(2s);
    CHECK(talk.messages("/clock").empty());
}

TEST_CASE("rosbridge: a message arrives with the level that Friis' equation gives") {
    RosTalk talk(three_in_a_row());
    talk.subscribe("/B/radio/received");
    talk.subscribe("/C/radio/received");
    const Json sent =
        talk.call("/A/radio/send", {{"dst_address", "*"}, {"dst_port", 7}, {"data", "Rg=="}});
    CHECK(sent["accepted"] == true);
    CHECK(sent["uid"] == 0);
    talk.run_until(400ms);
    const auto told = talk.told();
    REQUIRE(told.size() == 2);
    const Json at_b = told[0]["msg"], at_c = told[1]["msg"];
    CHECK(told[0]["topic"] == "/B/radio/received");
    CHECK(at_b["src_address"] == "A");
    CHECK(at_b["last_hop"] == "A");
    CHECK(at_b["dst_address"] == "*");
    CHECK(at_b["dst_port"] == 7);
    CHECK(at_b["hops"] == 1);
    CHECK(at_b["data"] == "Rg==");
    CHECK(at_c["last_hop"] == "B");
    CHECK(at_c["hops"] == 2);
    // 45 mW, 2450 MHz, 150 m; c is exact. Both hops are as long.
    const double wavelength = 299'792'458 / 2.45e9;
    const double level =
        10 * std::log10(45.0) + 20 * std::log10(wavelength / (4 * std::numbers::pi * 150));
    CHECK(std::abs(at_b["rssi"].get<double>() - level) < exact);
    CHECK(std::abs(at_c["rssi"].get<double>() - level) < exact);
    CHECK(at_b["stamp"]["sec"] == 0);
}

TEST_CASE(
    "rosbridge: a message to one robot reaches only this robot; a robot that is off sends none") {
    RosTalk talk(three_in_a_row());
    for (const char* topic : {"/A/radio/received", "/C/radio/received"}) talk.subscribe(topic);
    talk.publish("/B/radio/send", {{"dst_address", "C"}, {"data", {1, 255}}, {"size", 64}});
    talk.run_until(300ms);
    const auto told = talk.told();
    REQUIRE(told.size() == 1);
    CHECK(told[0]["topic"] == "/C/radio/received");
    CHECK(told[0]["msg"]["dst_address"] == "C");
    CHECK(told[0]["msg"]["data"] == "Af8=");
    talk.session.network().switch_off({1});
    const Json answer = talk.call("B/radio/send", {{"data", ""}});
    CHECK(answer["accepted"] == false);
    CHECK(answer["uid"].is_null());
}

TEST_CASE("rosbridge: neighbours are the robots in range, with the time of their last signal") {
    RosTalk talk(three_in_a_row());
    talk.subscribe("/B/radio/neighbors");
    talk.run_until(400ms);
    const Json quiet = talk.messages("/B/radio/neighbors").back();
    REQUIRE(quiet["neighbors"].size() == 2);
    CHECK(quiet["neighbors"][0]["address"] == "A");
    CHECK(quiet["neighbors"][0]["ip"] == "10.0.0.1");
    CHECK(quiet["neighbors"][0]["frequency"] == 2450);
    CHECK(quiet["neighbors"][1]["last_heard"].is_null());
    talk.run_until(700ms);
    const Json later = talk.messages("/B/radio/neighbors").back();
    const double heard = stamp(later["neighbors"][0]["last_heard"]);  // A speaks at 0.5 s
    CHECK(heard > 0.5);
    CHECK(heard < 0.51);
    CHECK(later["neighbors"][1]["address"] == "C");
    CHECK(later["neighbors"][1]["last_heard"].is_null());
}

TEST_CASE("rosbridge: topics that never change, such as /map, are sent once to each subscriber") {
    RosTalk talk(office());
    talk.subscribe("/map");
    const auto maps = talk.messages("/map");
    REQUIRE(maps.size() == 1);
    const Json& map = maps[0];
    CHECK(map["header"]["frame_id"] == "map");
    CHECK(map["info"]["resolution"] == 0.1);
    CHECK(map["info"]["width"] == 480);
    CHECK(map["info"]["height"] == 240);
    REQUIRE(map["data"].size() == 480 * 240);
    // Against the picture: dark is a wall, and its last row is the map's first.
    const Image office_png = read_image(ROVERNET_EXAMPLES "/rescue/office.png");
    for (int row = 0; row < 240; ++row) {
        for (int column = 0; column < 480; ++column) {
            const bool is_wall = office_png.rgb_sum(column, 239 - row) < 383;
            const int told = map["data"][static_cast<std::size_t>(row * 480 + column)];
            if (told != (is_wall ? 100 : 0)) FAIL(column << ", " << row << ": " << told);
        }
    }
    talk.subscribe("/tf_static");
    const auto frames = talk.messages("/tf_static");
    REQUIRE(frames.size() == 1);
    CHECK(frames[0]["transforms"][1]["header"]["frame_id"] == "map");
    CHECK(frames[0]["transforms"][1]["child_frame_id"] == "B/odom");
    talk.run_until(1s);
    CHECK(talk.told().empty());
}

TEST_CASE("rosbridge: the map has square cells, also if the cells of the scene are not square") {
    const TemporaryFolder folder;
    folder.write("m.pgm", "P2 4 3 255\n255 255 255 0\n255 255 255 255\n0 255 255 255\n");
    const std::string map = "[scene]\nmap = \"m.pgm\"\nsize = [\"8 m\", \"3 m\"]\n";
    RosTalk talk(load_scenario(
        folder.write("s.toml", map + "[[robot]]\nname = \"A\"\nat = [\"4 m\", \"1.5 m\"]\n"), {}));
    talk.subscribe("/map");
    const Json told = talk.messages("/map").at(0);
    CHECK(told["info"]["resolution"] == 1);
    CHECK(told["info"]["width"] == 8);
    CHECK(told["info"]["height"] == 3);
    CHECK(told["data"] == Json{100, 100, 0, 0, 0, 0, 0,   0,  //
                               0,   0,   0, 0, 0, 0, 0,   0,  //
                               0,   0,   0, 0, 0, 0, 100, 100});
}

TEST_CASE("rosbridge: a scan is equal in JSON and CBOR, and infinity means no obstacle") {
    RosTalk talk(office());
    talk.subscribe("/A/scan");
    talk.come(1);
    talk.say(R"({"op":"subscribe","topic":"/A/scan","compression":"cbor"})", 1);
    CHECK(talk.ask(R"({"op":"subscribe","topic":"/B/scan"})")[0]["op"] == "status");
    talk.run_until(100ms);
    const Json json = talk.messages("/A/scan").at(0), cbor = talk.messages("/A/scan", 1).at(0);
    const auto ranges = numbers<float>(cbor["ranges"]);
    REQUIRE(ranges.size() == 181);
    REQUIRE(json["ranges"].size() == 181);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const float range = json["ranges"][i].is_null() ? std::numeric_limits<float>::infinity()
                                                        : json["ranges"][i].get<float>();
        CHECK(range == ranges[i]);
        CHECK((range < 8 || std::isinf(range)));
    }
    CHECK(json["angle_min"] == cbor["angle_min"]);
    CHECK(std::abs(json["angle_min"].get<double>() + std::numbers::pi / 2) < exact);
    CHECK(json["header"] == cbor["header"]);
}

TEST_CASE("rosbridge: CBOR bytes equal the examples of RFC 8949 and RFC 8746") {
    std::string bytes;
    RosCborWriter out(bytes);
    for (const std::int64_t each : {0, 23, 24, 1000, -1, -500, 1'000'000}) out.whole(each);
    CHECK(bytes ==
          std::string("\x00\x17\x18\x18\x19\x03\xe8\x20\x39\x01\xf3\x1a\x00\x0f\x42\x40", 16));
    bytes.clear();
    out.whole(1'000'000'000'000);
    out.number(1.1);
    CHECK(bytes ==
          std::string("\x1b\x00\x00\x00\xe8\xd4\xa5\x10\x00\xfb\x3f\xf1\x99\x99\x99\x99\x99\x9a",
                      18));
    bytes.clear();
    const std::vector<float> floats = {1, 2.5F, -3};  // as captured from a server
    out.numbers(floats);
    CHECK(bytes == std::string("\xd8\x55\x4c\x00\x00\x80\x3f\x00\x00\x20\x40\x00\x00\x40\xc0", 15));
}

TEST_CASE("rosbridge: a client sends a robot to a goal, and places the robot elsewhere") {
    RosTalk talk(office());
    talk.publish("/A/goal_pose", {{"header", {{"frame_id", "map"}}},
                                  {"pose", {{"position", {{"x", 25}, {"y", 12}}}}}});
    talk.run_until(1500ms);
    const Vec3 at = talk.session.network().position({0});
    CHECK(std::abs(at.x - 25) < exact);
    CHECK(std::abs(at.y - 12) < exact);
    const double half = std::numbers::pi / 4;
    talk.call("/simulation/set_pose",
              {{"name", "A"},
               {"pose",
                {{"position", {{"x", 24}, {"y", 12.5}}},
                 {"orientation", {{"z", std::sin(half)}, {"w", std::cos(half)}}}}}});
    CHECK(talk.session.network().position({0}).y == 12.5);
    CHECK(std::abs(talk.session.network().heading({0}).value - std::numbers::pi / 2) < exact);
}

TEST_CASE(
    "rosbridge: a goal off the map is answered with a status message that has the extent of the "
    "map") {
    RosTalk talk(office());
    const auto told = talk.ask(
        R"({"op":"publish","topic":"/A/goal_pose","msg":{"pose":{"position":{"x":448,"y":12}}}})");
    REQUIRE(told.size() == 1);
    CHECK(told[0]["msg"] ==
          "msg.pose.position: (448, 12) m is off the map, which goes from (0, 0) to (48, 24) m");
}

TEST_CASE("rosbridge: a robot climbs stairs, and odometry and transforms have its height") {
    RosTalk talk(load_scenario(ROVERNET_EXAMPLES "/storeys/storeys.toml", {}));
    const NodeId courier = *talk.session.network().find("courier");
    const auto pose = [](double x, double y, std::optional<double> z = {}) {
        Json position{{"x", x}, {"y", y}};
        if (z) position["z"] = *z;
        return Json{{"pose", {{"position", position}}}};
    };
    talk.subscribe("/courier/odom");
    talk.subscribe("/tf");
    talk.publish("/courier/goal_pose", pose(5.5, 8.4, 0));
    talk.run_until(7s);
    talk.publish("/courier/goal_pose", pose(9.5, 8.4, 3));  // 5 m in space, at 1 m/s
    talk.told();
    talk.run_until(12s);
    int count = 0;
    for (const Json& each : talk.told()) {
        const Json& message = each["msg"];
        const bool is_odometry = each["topic"] == "/courier/odom";
        const Json stamped = is_odometry ? message : message["transforms"][courier.value];
        const Json at =
            is_odometry ? stamped["pose"]["pose"]["position"] : stamped["transform"]["translation"];
        const double risen = 0.6 * (stamp(stamped["header"]["stamp"]) - 7);  // [m]
        CHECK(std::abs(at["z"].get<double>() - risen) < exact);
        ++count;
    }
    CHECK(count == 200);
    talk.publish("/courier/goal_pose", pose(13.2, 2));
    talk.run_until(24s);
    CHECK(talk.session.network().position(courier) == Vec3{13.2, 2, 3});
    const auto put = [&](const Json& where) {
        talk.call("/simulation/set_pose", {{"name", "courier"}, {"pose", where["pose"]}});
        return talk.session.network().position(courier);
    };
    CHECK(put(pose(12, 2)) == Vec3{12, 2, 3});
    CHECK(put(pose(2.5, 3, 0)) == Vec3{2.5, 3, 0});
}

TEST_CASE("rosbridge: time stands still while it is paused, and advances by steps") {
    RosTalk talk(three_in_a_row());
    talk.run_until(105ms);
    talk.call("/simulation/pause");
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 105ms);
    talk.subscribe("/clock");
    talk.say(
        R"({"op":"call_service","id":"s","service":"/simulation/step","args":{"seconds":0.02}})");
    CHECK(talk.told().empty());
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 125ms);
    const auto told = talk.told();
    REQUIRE(told.size() == 4);  // 110, 120, 125 ms, and the answer
    CHECK(told[2]["msg"]["clock"]["nanosec"] == 125'000'000);
    CHECK(told[3]["id"] == "s");
    CHECK(told[3]["values"]["time"]["nanosec"] == 125'000'000);
    talk.call("/simulation/unpause");
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 1s);
    talk.say(R"({"op":"call_service","id":"t","service":"/simulation/step","args":{"seconds":9}})");
    talk.run_until(2s);
    CHECK(talk.told().back()["id"] == "t");  // at the end of the scenario
}

TEST_CASE("rosbridge: time continues when the last client that paused it has left") {
    RosTalk talk(three_in_a_row());
    const auto ask = [&](Front::Connection client, const std::string& what) {
        talk.say(
            R"({"op":"call_service","args":{"seconds":0.2},"service":"/simulation/)" + what + "\"}",
            client);
    };
    for (const Front::Connection client : {1U, 2U, 3U}) talk.come(client);
    talk.run_until(100ms);
    ask(1, "pause");
    ask(2, "step");
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 300ms);
    talk.go(3);  // has held nothing
    talk.go(1);
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 300ms);
    talk.go(2);
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 1s);
    ask(0, "pause");
    ask(0, "unpause");  // then it does not hold it any more
    talk.come(4);
    ask(4, "pause");
    talk.go(4);
    talk.run_until(2s);
    CHECK(talk.session.network().now() == start_of_run + 2s);
}

TEST_CASE("rosbridge: simultaneous steps of several clients each have the requested length") {
    RosTalk talk(three_in_a_row());
    talk.come(1);
    const auto step = [&](const std::string& seconds, Front::Connection client) {
        talk.say(R"({"op":"call_service","service":"/simulation/step","args":{"seconds":)" +
                     seconds + "}}",
                 client);
    };
    step("0.3", 0);
    step("0.1", 1);
    talk.run_until(50ms);
    step("0.1", 1);
    talk.run_until(1s);
    const auto times = [&](Front::Connection client) {
        std::vector<double> found;
        for (const Json& each : talk.told(client)) found.push_back(stamp(each["values"]["time"]));
        return found;
    };
    CHECK(times(0) == std::vector<double>{0.3});
    CHECK(times(1) == std::vector<double>{0.1, 0.15});
    CHECK(talk.session.network().now() == start_of_run + 300ms);
    step("0.5", 0);
    talk.run_for(100ms);
    talk.come(2);
    talk.say(R"({"op":"call_service","service":"/simulation/pause"})", 2);
    CHECK(times(0) == std::vector<double>{0.4});  // another has overtaken it
    talk.run_until(1s);
    CHECK(talk.session.network().now() == start_of_run + 400ms);
}

TEST_CASE("rosbridge: a client may have at most 64 unfinished steps") {
    RosTalk talk(three_in_a_row());
    talk.come(1);
    const auto step = [&](int id, Front::Connection client) {
        return talk.ask(R"({"op":"call_service","id":")" + std::to_string(id) +
                            R"(","service":"/simulation/step","args":{"seconds":0.1}})",
                        client);
    };
    for (int id = 0; id < 64; ++id) CHECK(step(id, 0).empty());
    for (int id = 64; id < 70; ++id) {
        const auto told = step(id, 0);
        REQUIRE(told.size() == 1);
        CHECK(told[0]["op"] == "service_response");
        CHECK(told[0]["id"] == std::to_string(id));
        CHECK(told[0]["result"] == false);
        CHECK(told[0]["values"].get<std::string>().find("64") != std::string::npos);
    }
    CHECK(step(0, 1).empty());  // another client has its own
    talk.run_until(1s);
    CHECK(talk.told(0).size() == 64);
    CHECK(talk.session.network().now() == start_of_run + 100ms);
    CHECK(step(70, 0).empty());
}

TEST_CASE("rosbridge: robots stop when the client that drove them last has left") {
    RosTalk talk(three_in_a_row());
    talk.come(1);
    talk.publish("/A/cmd_vel", twist(1, 0), 1);
    talk.publish("/B/cmd_vel", twist(1, 0), 1);
    talk.publish("/B/cmd_vel", twist(0.5, 0));
    talk.run_until(1s);
    talk.go(1);
    CHECK(talk.session.twist({0}).speed == 0);
    CHECK(talk.session.twist({1}).speed == 0.5);
    talk.run_until(1500ms);
    CHECK(std::abs(talk.session.network().position({0}).x - 1) < exact);
}

TEST_CASE("rosbridge: rosapi lists topics, services and nodes") {
    RosTalk talk(three_in_a_row());
    const Json topics = talk.call("rosapi/topics");
    REQUIRE(topics["topics"].size() == topics["types"].size());
    CHECK(topics["topics"].size() == 4 + 3 * 6);  // nobody has a scan
    std::map<std::string, std::string> type;
    for (std::size_t i = 0; i < topics["topics"].size(); ++i) {
        type[topics["topics"][i]] = topics["types"][i];
        CHECK(talk.call("/rosapi/topic_type", {{"topic", topics["topics"][i]}})["type"] ==
              topics["types"][i]);
    }
    CHECK(type["/clock"] == "rosgraph_msgs/Clock");
    CHECK(type["/C/radio/send"] == "rovernet_msgs/Send");
    CHECK(talk.call("rosapi/get_param", {{"name", "/use_sim_time"}}) ==
          Json::parse(R"({"value":"true","successful":true,"reason":""})"));
    CHECK(talk.call("rosapi/get_param", {{"name", "x"}})["successful"] == false);
    CHECK(talk.call("rosapi/topics_for_type", {{"type", "nav_msgs/msg/Odometry"}})["topics"] ==
          Json{"/A/odom", "/B/odom", "/C/odom"});
    CHECK(talk.call("rosapi/publishers", {{"topic", "/A/odom"}})["publishers"] ==
          Json{"/rovernet"});
    CHECK(talk.call("rosapi/subscribers", {{"topic", "/A/odom"}})["subscribers"].empty());
    CHECK(talk.call("rosapi/subscribers", {{"topic", "A/cmd_vel"}})["subscribers"] ==
          Json{"/rovernet"});
    const Json services = talk.call("rosapi/services")["services"];
    CHECK(services.size() == 19 + 3);
    for (const Json& each : services) {
        CHECK_FALSE(talk.call("rosapi/service_type", {{"service", each}})["type"] == "");
    }
    CHECK(talk.call("rosapi/node_details", {{"node", "/rovernet"}})["subscribing"].size() == 9);
    CHECK(talk.call("rosapi/get_param_names")["names"] == Json{"/use_sim_time"});
    talk.run_until(1234567890ns);
    CHECK(talk.call("rosapi/get_time")["time"] == Json::parse(R"({"sec":1,"nanosec":234567890})"));
}

namespace {

/// Checks that a message has the members of its type, in their order.
void check_members(const Json& message, const std::string& type_name) {
    const RosType* type = find_type(type_name);
    if (!type || message.is_null()) return;
    const auto members = type->members();
    CAPTURE(type_name);
    REQUIRE(message.size() == members.size());
    for (const RosMember& member : members) {
        CAPTURE(member.name);
        REQUIRE(message.contains(member.name));
        if (!member.elements) {
            check_members(message[member.name], member.type);
        } else if (find_type(member.type)) {
            for (const Json& each : message[member.name]) check_members(each, member.type);
        }
    }
}

}  // namespace

TEST_CASE("rosbridge: every message has the members of its type, and rosapi describes every type") {
    RosTalk talk(office());
    const Json topics = talk.call("rosapi/topics");
    std::map<std::string, std::string> types;
    std::set<std::string> told;
    for (std::size_t i = 0; i < topics["topics"].size(); ++i) {
        types[topics["topics"][i]] = topics["types"][i];
        talk.subscribe(topics["topics"][i], {{"type", topics["types"][i]}});
        const Json details = talk.call("rosapi/message_details", {{"type", topics["types"][i]}});
        CHECK(details["typedefs"][0]["type"] == topics["types"][i]);
        for (const Json& each : details["typedefs"]) {
            CHECK(each["fieldnames"].size() == each["fieldarraylen"].size());
        }
    }
    talk.publish("/B/radio/send", {{"data", "Rg=="}});
    talk.subscribe("/map");
    talk.subscribe("/tf_static");
    talk.run_until(200ms);
    for (const Json& each : talk.told()) {
        told.insert(each["topic"].get<std::string>());
        check_members(each["msg"], types.at(each["topic"]));
    }
    CHECK(told == std::set<std::string>{"/clock", "/tf", "/tf_static", "/map", "/A/odom", "/B/odom",
                                        "/A/scan", "/A/radio/received", "/A/radio/neighbors",
                                        "/B/radio/neighbors"});
    const Json raw = talk.call("rosapi/topics_and_raw_types");
    CHECK(raw["typedefs_full_text"][0].get<std::string>().find("MSG: builtin_interfaces/Time") !=
          std::string::npos);
}

TEST_CASE("rosbridge: an invalid message gets an error, and the connection continues") {
    struct Row {
        const char* message;
        const char* why;  // part of the status
    };
    const Row rows[] = {
        {"", "expected one JSON object"},
        {"[]", "expected an object"},
        {"{", "expected one JSON object"},
        {"\"op\"", "expected an object"},
        {R"({"op":"status\xff"})", "expected one JSON object"},
        {"{\"op\":\"\xff\"}", "not UTF-8"},
        {R"({"id":"x"})", "\"op\" is missing"},
        {R"({"op":5})", "expected a text"},
        {R"({"op":"fly","id":"x"})", "unknown operation \"fly\""},
        {R"({"op":"subscribe"})", "\"topic\" is missing"},
        {R"({"op":"subscribe","topic":"/odom"})", "there is no topic /odom"},
        {R"({"op":"subscribe","topic":"/A/odom","type":"std_msgs/String"})",
         "expected nav_msgs/Odometry"},
        {R"({"op":"subscribe","topic":"/A/odom","compression":"cbor-raw"})",
         "expected \"none\" or \"cbor\""},
        {R"({"op":"subscribe","topic":"/map","compression":"png"})",
         "found \"png\"; expected \"none\" or \"cbor\""},
        {R"({"op":"subscribe","topic":"/A/odom","throttle_rate":-1})", "from 0 to 1e9 ms"},
        {R"({"op":"subscribe","topic":"/A/odom","queue_length":1e9})", "from 0 to 1000"},
        {R"({"op":"advertise","topic":"/A/odom","type":"nav_msgs/Odometry"})",
         "only rovernet publishes this topic"},
        {R"({"op":"advertise","topic":"/A/cmd_vel","type":"std_msgs/String"})",
         "expected geometry_msgs/Twist"},
        {R"({"op":"publish","topic":"/A/cmd_vel"})", "\"msg\" is missing"},
        {R"({"op":"publish","topic":"/X/cmd_vel","msg":{}})", "there is no topic /X/cmd_vel"},
        {R"({"op":"publish","topic":"/A/cmd_vel","msg":{"data":"hello"}})",
         "msg.data: unknown key"},
        {R"({"op":"publish","topic":"/A/cmd_vel","msg":{"linear":{"x":"fast"}}})",
         "msg.linear.x: found a text"},
        {R"({"op":"publish","topic":"/A/cmd_vel","msg":{"linear":{"x":1001}}})",
         "from -1000 to 1000"},
        {R"({"op":"publish","topic":"/A/cmd_vel","msg":{"twist":1}})", "msg.twist: found 1"},
        {R"({"op":"publish","topic":"/A/goal_pose","msg":{}})", "\"pose\" is missing"},
        {R"({"op":"publish","topic":"/A/goal_pose","msg":{"header":{"frame_id":"B/odom"},"pose":{}}})",
         "expected \"map\" or \"A/odom\""},
        {R"({"op":"publish","topic":"/A/radio/send","msg":{"data":"R"}})", "expected base64"},
        {R"({"op":"publish","topic":"/A/radio/send","msg":{"data":[256]}})",
         "msg.data[0]: found 256"},
        {R"({"op":"publish","topic":"/A/radio/send","msg":{"data":"","dst_address":"D"}})",
         "no robot D"},
        {R"({"op":"publish","topic":"/A/radio/send","msg":{"data":"","dst_address":"A"}})",
         "expected a different robot"},
        {R"({"op":"set_level","level":"loud"})", "expected info, warning, error, none"},
        {R"({"op":"auth","mac":"m"})", "refused"},
        {R"({"op":"advertise_service","service":"/mine","type":"a/B"})", "refused"},
        {R"({"op":"advertise_action","action":"/mine","type":"a/B"})", "refused"},
        {R"({"op":"fragment","id":"1","data":"","num":0,"total":2})",
         "unknown operation \"fragment\""},
    };
    RosTalk talk(three_in_a_row());
    for (const Row& row : rows) {
        CAPTURE(row.message);
        const auto told = talk.ask(row.message);
        REQUIRE(told.size() == 1);
        CHECK(told[0]["op"] == "status");
        CHECK(told[0]["level"] == "error");
        CAPTURE(told[0]["msg"]);
        CHECK(told[0]["msg"].get<std::string>().find(row.why) != std::string::npos);
        CHECK(told[0].value("id", "") ==
              (std::string(row.message).find(R"("id":"x")") != std::string::npos   ? "x"
               : std::string(row.message).find(R"("id":"1")") != std::string::npos ? "1"
                                                                                   : ""));
    }
    CHECK(talk.ask(std::string(40, '[') + std::string(40, ']'))[0]["msg"] ==
          "expected 32 levels of brackets at most");
    CHECK(talk.call("rosapi/nodes")["nodes"] == Json{"/rovernet"});
}

TEST_CASE("rosbridge: the answer to a failed service call has the id of the call") {
    struct Row {
        const char* call;
        const char* why;
    };
    const Row rows[] = {
        {R"("service":"/nowhere")", "service: there is no service /nowhere"},
        {R"("service":"/rosapi/topic_type")", "\"args\" is missing"},
        {R"("service":"/rosapi/topic_type","args":{})", "\"topic\" is missing"},
        {R"("service":"/rosapi/topic_type","args":{"topic":1})", "expected a text"},
        {R"("service":"/simulation/step","args":{"seconds":0})", "above 0"},
        {R"("service":"/simulation/set_pose","args":{"name":"D","pose":{}})", "no robot D"},
        {R"("service":"/simulation/set_pose","args":{"name":"A","pose":{}})",
         "\"position\" is missing"},
        {R"("service":"/A/radio/send","args":{"data":"","colour":1})", "args.colour: unknown key"},
    };
    RosTalk talk(three_in_a_row());
    for (const Row& row : rows) {
        CAPTURE(row.call);
        const auto told =
            talk.ask(std::string(R"({"op":"call_service","id":"7",)") + row.call + "}");
        REQUIRE(told.size() == 1);
        CHECK(told[0]["op"] == "service_response");
        CHECK(told[0]["id"] == "7");
        CHECK(told[0]["result"] == false);
        CAPTURE(told[0]["values"]);
        CHECK(told[0]["values"].get<std::string>().find(row.why) != std::string::npos);
    }
    const auto goal = talk.ask(
        R"({"op":"send_action_goal","id":"g","action":"/fib","action_type":"a/B","args":{}})");
    REQUIRE(goal.size() == 1);
    CHECK(goal[0]["op"] == "action_result");
    CHECK(goal[0]["id"] == "g");
    CHECK(goal[0]["result"] == false);
}

TEST_CASE("rosbridge: status messages below the level that a client has set are not sent") {
    RosTalk talk(three_in_a_row());
    const Json sideways = {{"linear", {{"y", 1}}}};
    talk.publish("/A/cmd_vel", sideways);
    CHECK(talk.told().empty());
    CHECK(talk.ask(R"({"op":"set_level","level":"warning"})").empty());
    talk.publish("/B/cmd_vel", sideways);
    const auto told = talk.told();
    REQUIRE(told.size() == 1);
    CHECK(told[0]["level"] == "warning");
    talk.publish("/B/cmd_vel", sideways);  // it is told once
    CHECK(talk.told().empty());
    talk.say(R"({"op":"set_level","level":"none"})");
    CHECK(talk.ask("{").empty());
}

TEST_CASE("rosbridge: subscriptions are limited, and robots of other clients cannot be driven") {
    RosTalk talk(three_in_a_row());
    for (int i = 0; i < 256; ++i) talk.subscribe("/clock", {{"id", std::to_string(i)}});
    CHECK(talk.told().empty());
    talk.subscribe("/tf");
    CHECK(talk.told().at(0)["op"] == "status");
    talk.session.attach({{2}}, "another");
    talk.publish("/C/cmd_vel", twist(1, 0));
    CHECK(talk.told().at(0)["msg"] ==
          "robot C is driven by another program, so ROS clients cannot drive it");
}

TEST_CASE("rosbridge: messages captured from the library roslib are understood") {
    const TemporaryFolder folder;
    RosTalk talk(load_scenario(folder.write("r1.toml", R"([scenario]
duration = "2 s"
[propagation]
model = "friis"
[[robot]]
name = "r1"
at = ["0 m", "0 m"]
)"),
                               {}));
    std::ifstream file(ROVERNET_TEST_DATA "/rosbridge/roslib.log");
    std::map<std::string, std::vector<std::string>> answers;  // by operation and target
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("C>S ")) continue;
        const Json said = Json::parse(line.substr(4));
        std::string key = said["op"];
        for (const char* target : {"topic", "service", "action"})
            key += " " + said.value(target, "");
        for (const Json& each : talk.ask(line.substr(4))) {
            if (each["op"] == "service_response") CHECK(each["id"] == said["id"]);
            answers[key].push_back(each["op"].get<std::string>() +
                                   (each.value("result", true) ? "" : " failed"));
        }
    }
    using Answers = std::map<std::string, std::vector<std::string>>;
    Answers of_note;  // other than an answer to a call of rosapi
    for (const auto& [key, ops] : answers) {
        const bool is_api = key.starts_with("call_service  rosapi/");
        if (!is_api || ops != std::vector<std::string>{"service_response"}) of_note[key] = ops;
    }
    const std::vector<std::string> refused = {"status"}, failed = {"service_response failed"};
    const Answers expected = {
        {"auth   ", refused},
        {"call_service  /add ", failed},
        {"call_service  /fails ", failed},
        // What rovernet does not have: messages as pictures, lists of actions, parameters to set,
        // types of services, services and actions of clients, and the republisher of tf2.
        {"subscribe /map  ", refused},
        {"call_service  rosapi/action_servers ", failed},
        {"call_service  rosapi/set_param ", failed},
        {"call_service  rosapi/delete_param ", failed},
        {"call_service  rosapi/service_request_details ", failed},
        {"call_service  rosapi/service_response_details ", failed},
        {"advertise_service  /mine ", refused},
        {"service_response  /mine ", refused},
        {"unadvertise_service  /mine ", refused},
        {"advertise_action   /srvact", refused},
        {"action_feedback   /srvact", refused},
        {"action_result   /srvact", refused},
        {"unadvertise_action   /srvact", refused},
        {"send_action_goal   /fib", {"action_result failed"}},
        {"send_action_goal   /tf2_web_republisher", {"action_result failed"}},
        {"advertise /tf2_web_republisher/goal  ", refused},
        {"advertise /tf2_web_republisher/cancel  ", refused},
        {"publish /tf2_web_republisher/goal  ", refused},
    };
    CHECK(of_note == expected);
}

}  // namespace rosbridge_test
