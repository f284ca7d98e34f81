// SPDX-License-Identifier: MIT
// Player's configuration files, and the listeners that follow from them.
#include "live/player/config.hpp"

#include "live/player/listeners.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace config_test {
using namespace rovernet;
using namespace rovernet::test;

namespace {

const std::string head = R"(# a world with two robots
driver
(
  name "stage"
  provides [ "simulation:0" ]
  plugin "stageplugin"
  worldfile "worlds/two.world"
)
)";
const std::string robots = R"(
driver ( name "stage" provides [ "6665:position2d:0" "6665:laser:0" ] model "r0" )
driver ( name "stage" provides [ "6666:wifi:1" "6666:position2d:1" ] model "r1" )
driver ( name "stage" provides [ "6666:position2d:0" ] model "r2" )
driver ( name "stage" provides [ "map:0" ] model "cave" )
driver ( name "vfh" requires [ "position2d:1" ] provides [ "position2d:5" ] )
)";

PlayerConfig read(const std::string& text) {
    const TemporaryFolder folder;
    return read_player_config(folder.write("two.cfg", text));
}

}  // namespace

TEST_CASE("player configuration: world, robots and their ports are read") {
    const PlayerConfig config = read(head + robots);
    CHECK(config.world.ends_with("/worlds/two.world"));
    REQUIRE(config.robots.size() == 3);
    CHECK(config.robots[0].model == "r0");
    CHECK(config.robots[0].port == 6665);
    CHECK(config.robots[1].port == 6666);
    CHECK(config.robots[1].index == 1);
    CHECK(config.robots[2].where.line == 12);
    CHECK(read(head + R"(driver ( name "stage" provides ["position2d:3"] model "r" ))")
              .robots[0]
              .port == 6665);
    CHECK(
        read(
            head +
            R"(driver ( name "stage" provides ["odometry:localhost:7000:position2d:3"] model "r" ))")
            .robots[0]
            .port == 7000);
    CHECK(read(head + R"(driver ( name "stage" provides ["odometry:::position2d:3"] model "r" ))")
              .robots[0]
              .index == 3);
}

TEST_CASE("player configuration: blanks in an address and lists over several lines are accepted") {
    const PlayerConfig config = read(head + R"(driver ( name "stage" provides [
  " 7001 :position2d: 2 "   # where it drives
  "7001:ranger:1 "
] model "r" ))");
    REQUIRE(config.robots.size() == 1);
    CHECK(config.robots[0].port == 7001);
    CHECK(config.robots[0].index == 2);
    CHECK(config.notices.empty());
}

TEST_CASE(
    "player configuration: a `comdriver` or `relay` belongs to the robot whose radio it uses") {
    const PlayerConfig config = read(head + R"(
driver ( name "comdriver" provides [ "6666:opaque:3" ] requires [ "6666:wifi:1" "6666:opaque:2" ]
         mapping [ "192.168.0.1" 6665
                   "192.168.0.9" 6666 ] )
driver ( name "stage" provides [ "6665:position2d:0" "6665:wifi:0" ] model "r0" )
driver ( name "stage" provides [ "6666:position2d:0" "6666:wifi:0" ] model "r1" )
driver ( name "stage" provides [ "6666:position2d:1" "6666:wifi:1" ] model "r2" )
driver ( name "relay" provides [ "6666:opaque:0" ] )
driver ( name "amcl" provides [ "localize:0" ] )
driver ( name "vfh" provides [ "6665:position2d:1" ] )
driver ( name "comdriver" provides [ "6667:opaque:1" ] )
)");
    REQUIRE(config.robots.size() == 3);
    CHECK(config.has_comdriver());
    CHECK(!config.robots[0].comdriver);
    CHECK(!config.robots[1].comdriver);
    CHECK(config.robots[1].relay == 0);
    REQUIRE(config.robots[2].comdriver);
    CHECK(config.robots[2].comdriver->index == 3);
    REQUIRE(config.robots[2].comdriver->mapping.size() == 2);
    CHECK(config.robots[2].comdriver->mapping[1].ip == "192.168.0.9");
    CHECK(config.robots[2].comdriver->mapping[1].port == 6666);
    REQUIRE(config.notices.size() == 1);
    CHECK(config.notices[0].ends_with(
        "two.cfg:17: these drivers of the Player server are not supported, and their devices are "
        "missing: amcl, vfh, comdriver at port 6667, which has no robot"));

    const auto notices = mapping_notices(config, {"192.168.0.1", "192.168.0.2", "192.168.0.3"});
    REQUIRE(notices.size() == 2);
    CHECK(notices[0].ends_with("has this IP address at this port: 192.168.0.9 6666"));
    CHECK(notices[1].find("mapping leaves out r1; these robots nevertheless receive") !=
          std::string::npos);
    CHECK(mapping_notices(config, {"192.168.0.1", "192.168.0.9", ""}).empty());
    CHECK(!read(head + robots).has_comdriver());
}

TEST_CASE(
    "player configuration: the error for an invalid address or driver has the file and the line") {
    const auto fault = [](const std::string& text) -> std::string {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(fault("").find("found no world") != std::string::npos);
    CHECK(fault(head).find("found no robot") != std::string::npos);
    CHECK(fault(robots).find("found no world") != std::string::npos);
    for (const char* address :
         {"position2d", "", "0:position2d:0", "65536:position2d:0", "x:position2d:0",
          "6665:position2d:", "6665:position2d:-1", "a:b:c:6665:position2d:0"}) {
        const std::string text =
            head + "driver ( name \"stage\" model \"r\" provides [ \"" + address + "\" ] )";
        CAPTURE(address);
        CHECK(fault(text).find("two.cfg:9") != std::string::npos);
        CHECK(fault(text).find("6665:position2d:0") != std::string::npos);
    }
    CHECK(fault(head + "driver ( name \"stage\" model \"r\" provides [ 6665 ] )")
              .find("expected texts") != std::string::npos);
    CHECK(fault(head + "driver ( name").find("two.cfg") != std::string::npos);
    const std::string com = head + robots + "driver ( name \"comdriver\" provides [\"opaque:1\"] ";
    for (const char* mapping :
         {"[\"1.2\"]", "[6665 \"1.2\"]", "[\"1.2\" 0]", "[\"1.2\" 6665.5]", "[\"1.2\" \"6665\"]"}) {
        CAPTURE(mapping);
        CHECK(fault(com + "mapping " + mapping + " )").find("mapping: expected pairs") !=
              std::string::npos);
    }
    CHECK(fault(head + robots + "driver ( name \"relay\" )")
              .find("relay: found no opaque device in \"provides\"") != std::string::npos);
    CHECK_THROWS_AS(read_player_config("/nowhere/two.cfg"), InputError);
}

TEST_CASE(
    "player listeners: there is a port for each robot, one port for all, or the ports of a "
    "configuration") {
    const std::vector<std::string> names = {"r0", "r1", "r2"};
    const FrontListeners ports = player_ports({"127.0.0.1", 7000}, names, {});
    REQUIRE(ports.entries.size() == 3);
    CHECK(ports.entries[2].at.text() == "127.0.0.1:7002");
    CHECK(ports.entries[2].what == "Player, robot r2");
    CHECK(player_ports({"127.0.0.1", 0}, names, {}).entries[2].at.text() == "127.0.0.1:0");
    CHECK(player_one_port({"::1", 7000}, names, {}).entries.size() == 1);
    const FrontListeners configured =
        player_configured({"127.0.0.1", 6665}, read(head + robots), names, {});
    REQUIRE(configured.entries.size() == 2);
    CHECK(configured.entries[1].at.text() == "127.0.0.1:6666");
    CHECK(configured.entries[1].what == "Player, robot r1, r2");
    CHECK_THROWS_AS(player_configured({"127.0.0.1", 6665}, read(head + robots), {"r0"}, {}),
                    InputError);
    CHECK_NOTHROW(player_ports({"127.0.0.1", 6665}, std::vector<std::string>(100, "r"), {}));
    CHECK_THROWS_AS(player_ports({"127.0.0.1", 6665}, std::vector<std::string>(101, "r"), {}),
                    std::invalid_argument);
    CHECK_THROWS_AS(player_ports({"127.0.0.1", 65535}, {"a", "b"}, {}), std::invalid_argument);
}

TEST_CASE(
    "player listeners: robots of [[robot]] tables, also with `count`, and of movement files are "
    "served") {
    const TemporaryFolder folder;
    folder.write("m.tcl", R"($node_(0) set X_ 1
$node_(0) set Y_ 2
$node_(0) set Z_ 0
$node_(1) set X_ 3
$node_(1) set Y_ 4
$node_(1) set Z_ 0
$ns_ at 1.0 "$node_(0) setdest 5 6 1"
)");
    const Scenario scenario = load_scenario(folder.write("s.toml", R"([movement]
file = "m.tcl"
[[robot]]
name = "r"
count = 2
at = ["0 m", "0 m"]
[[robot]]
name = "n1"
)"),
                                            {});
    CHECK(robot_names(scenario) == std::vector<std::string>{"r0", "r1", "n1", "n0"});
}

}  // namespace config_test
