// SPDX-License-Identifier: MIT
// Several range finders of a robot, as ROS clients find them.
#include "scenario/scenario_file.hpp"
#include "test/live/rosbridge/ros_talk.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

namespace scan_test {
using namespace rovernet;
using namespace rovernet::test;
using namespace std::chrono_literals;

namespace {

/// A robot with these range finders, and one 4 m ahead of it.
Scenario with_scan(const std::string& scan) {
    const TemporaryFolder folder;
    return load_scenario(folder.write("a.toml", R"([[robot]]
name = "A"
at = ["0 m", "0 m"]
scan = )" + scan + R"(
[[robot]]
name = "B"
at = ["4 m", "0 m"]
)"),
                         {});
}

const std::string ring = R"({ kind = "sonar", angles = ["0 deg", "90 deg"] })";
const std::string front = R"({ name = "front", beams = 1, from = "0 deg", to = "0 deg" })";
const std::string rear =
    R"({ name = "rear", beams = 2, from = "0 deg", to = "180 deg", at = ["-0.5 m", "0.25 m"], )"
    R"(heading = "180 deg", every = "200 ms" })";

/// Topics of LaserScan.
std::vector<std::string> scans(RosTalk& talk) {
    return talk.call("rosapi/topics_for_type", {{"type", "sensor_msgs/LaserScan"}})["topics"];
}

}  // namespace

TEST_CASE(
    "rosbridge: the first laser has the topic /A/scan, others /A/NAME/scan, a sonar ring no "
    "topic") {
    RosTalk talk(
        with_scan("[" + ring + ", { kind = \"ranger\", beams = 3 }, " + front + ", " + rear + "]"));
    CHECK(scans(talk) == std::vector<std::string>{"/A/ranger/scan", "/A/scan", "/A/rear/scan"});
    talk.subscribe("/A/scan");
    talk.subscribe("A/rear/scan");
    talk.run_until(200ms);
    const auto told = talk.told();
    std::vector<Json> first, second;
    for (const Json& each : told) {
        (each["topic"] == "/A/scan" ? first : second).push_back(each["msg"]);
    }
    REQUIRE(first.size() == 2);
    REQUIRE(first[0]["ranges"].size() == 1);
    CHECK(first[0]["ranges"][0].get<float>() == 3.8F);
    CHECK(first[0]["header"]["frame_id"] == "A/base_link");
    REQUIRE(second.size() == 1);
    CHECK(second[0]["header"]["frame_id"] == "A/rear_frame");
    CHECK(second[0]["angle_min"] == 0);
    CHECK(second[0]["ranges"].size() == 2);
    for (const char* none : {"/A/sonar/scan", "/A/front/scan", "/A/scan/scan", "/B/scan",
                             "/A//scan", "/scan", "/rear/scan", "/A/laser/scan"}) {
        CAPTURE(none);
        const auto refused = talk.ask(Json{{"op", "subscribe"}, {"topic", none}}.dump());
        REQUIRE(refused.size() == 1);
        CHECK(refused[0]["op"] == "status");
    }
}

TEST_CASE(
    "rosbridge: without a laser, the first fan of beams has the topic /A/scan; a ring of beams has "
    "no topic") {
    RosTalk talk(with_scan("[" + ring + ", { kind = \"ranger\", beams = 3 }]"));
    CHECK(scans(talk) == std::vector<std::string>{"/A/scan"});
    RosTalk rings(with_scan(ring));
    CHECK(scans(rings).empty());
}

TEST_CASE("rosbridge: a range finder beside the robot's centre has its own coordinate frame") {
    RosTalk talk(with_scan("[" + front + ", " + rear + "]"));
    talk.subscribe("/tf_static");
    const Json transforms = talk.messages("/tf_static").at(0)["transforms"];
    REQUIRE(transforms.size() == 3);
    CHECK(transforms[0]["child_frame_id"] == "A/odom");
    CHECK(transforms[2]["child_frame_id"] == "B/odom");
    const Json& own = transforms[1];
    CHECK(own["header"]["frame_id"] == "A/base_link");
    CHECK(own["child_frame_id"] == "A/rear_frame");
    CHECK(own["transform"]["translation"]["x"] == -0.5);
    CHECK(own["transform"]["translation"]["y"] == 0.25);
    CHECK(std::abs(own["transform"]["rotation"]["z"].get<double>() - 1) < 1e-12);
}

}  // namespace scan_test
