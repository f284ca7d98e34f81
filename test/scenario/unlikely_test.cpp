// SPDX-License-Identifier: MIT
// What a scenario says in its range and hardly means: a notice, or the end of it.
#include "scenario/unlikely.hpp"

#include "experiment/build.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/run.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/memory.hpp"
#include "scenario/scenario_file.hpp"
#include "scenario/unlikely_walls.hpp"
#include "test/scene/drawn_map.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace unlikely_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

const std::string robot_a = "[[robot]]\nname = \"A\"\nat = [\"2 m\", \"2 m\"]\n";
const std::string on_map = "[scene]\nmap = \"m.png\"\nsize = [\"8 m\", \"1 m\"]\n";

Scenario loaded(const TemporaryFolder& folder, const std::string& text) {
    return load_scenario(folder.write("s.toml", text), {});
}

std::vector<std::string> notices_of(const std::string& text) {
    const TemporaryFolder folder;
    const test::PngPicture picture{
        .width = 8, .height = 1, .rows = {{255, 255, 0, 100, 100, 255, 140, 255}}};
    folder.write("m.png", test::png_bytes(picture));
    return loaded(folder, text).notices;
}

/// One notice, with all these words.
void check_notice(const std::string& text, const std::vector<std::string>& words) {
    CAPTURE(text);
    const auto notices = notices_of(text);
    REQUIRE(notices.size() == 1);
    CAPTURE(notices[0]);
    for (const auto& word : words) CHECK(notices[0].find(word) != std::string::npos);
}

std::string error_of(auto&& make) {
    try {
        make();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("unlikely input: a usual scenario gives no notice") {
    CHECK(notices_of(robot_a) == std::vector<std::string>{});
    CHECK(notices_of(robot_a + "off = [\"1 s\", \"5 s\"]\non = [\"2 s\"]\n").empty());
    CHECK(notices_of("[access]\nmodel = \"csma\"\nstandard = \"802.11g\"\n" + robot_a).empty());
    CHECK(notices_of("[radio]\nfrequency = \"868 MHz\"\n" + robot_a).empty());
}

TEST_CASE("unlikely input: a time after the end of the run gives a notice") {
    const std::string run = "[scenario]\nduration = \"30 s\"\n" + robot_a;
    const std::string flow = "[[traffic]]\nfrom = \"A\"\npayload = \"x\"\nstart = ";
    check_notice(run + flow + "\"100 s\"\n",
                 {"s.toml:9:9: start: 100 s is after the end of the run (30 s)", "robot \"A\""});
    CHECK(notices_of(run + flow + "\"30 s\"\n").empty());
    check_notice(run + "off = [\"1 s\", \"31 s\"]\non = [\"2 s\"]\n", {"s.toml:6:7: off: 31 s is"});
    check_notice(run + "off = [\"1 s\"]\non = [\"40 s\"]\n", {"s.toml:7:6: on: 40 s is"});
    check_notice(run + "on_time = { time = \"1 min\", send = \"x\" }\n", {"on_time: 60 s is"});
}

TEST_CASE("unlikely input: a power such as 17 W, where 17 dBm is usual, gives a notice") {
    check_notice("[radio]\npower = \"17 W\"\n" + robot_a,
                 {"s.toml:2:9: power: 17 W are 42.3 dBm", "did you mean \"17 dBm\"?"});
    for (const char* power : {"37 dBm", "5 W", "100 W"})
        CHECK(notices_of("[radio]\npower = \"" + std::string(power) + "\"\n" + robot_a).empty());
}

TEST_CASE("unlikely input: a frequency with a wrong unit gives a notice with a suggestion") {
    check_notice("[radio]\nfrequency = \"2.4 MHz\"\n" + robot_a,
                 {"s.toml:2:13: frequency: ", "did you mean \"2400 MHz\"?"});
    check_notice(robot_a + "radio = { frequency = \"1 Hz\" }\n", {":4:23: ", "not a frequency of"});
}

TEST_CASE(
    "unlikely input: a data rate that the chosen 802.11 standard does not have gives a notice") {
    check_notice("[radio]\nrate = \"54 Mb/s\"\n[access]\nmodel = \"csma\"\n" + robot_a,
                 {":2:8: rate: standard 802.11b has no rate of 54 Mb/s", "1, 2, 5.5, 11"});
    check_notice(
        "[access]\nmodel = \"csma\"\nstandard = \"802.11a\"\nbasic_rates = [\"11 Mb/s\"]\n" +
            robot_a,
        {":4:15: basic_rates: standard 802.11a"});
    CHECK(notices_of("[radio]\nrate = \"54 Mb/s\"\n" + robot_a).empty());  // nobody's standard
}

TEST_CASE(
    "unlikely input: payload texts that look like sizes, such as 64 B, give one notice in total") {
    const auto traffic = [](const std::string& lines) {
        return "[[traffic]]\nfrom = \"A\"\n" + lines + "\n";
    };
    check_notice(
        robot_a + traffic("payload = \"64 B\""),
        {":6:11: payload: \"64 B\" is a text of 4 bytes on air", "did you mean size = \"64 B\"?"});
    check_notice(robot_a + traffic("payload = \"1.5 kB\"") + traffic("payload = \"2 kB\""),
                 {"size = \"1.5 kB\"?; and 1 more"});
    for (const char* words : {"F", "", "64", "64 m", "64 Bits", "B"}) {
        CAPTURE(words);
        CHECK(notices_of(robot_a + traffic(fmt::format("payload = \"{}\"", words))).empty());
    }
    CHECK(notices_of(robot_a + traffic("payload = \"64 B\"\nsize = \"64 B\"")).empty());
}

TEST_CASE(
    "unlikely input: with the protocol `flood`, a unicast goes one hop and gives a notice unless "
    "hops = 1") {
    const std::string two = robot_a + "[[robot]]\nname = \"B\"\nat = [\"4 m\", \"2 m\"]\n";
    const std::string unicast =
        "[[traffic]]\nkind = \"unicast\"\nfrom = \"A\"\nto = \"B\"\npayload = \"x\"\n";
    check_notice(two + unicast, {"s.toml:10:6", "to \"B\"", "one hop", "hops = 1"});
    check_notice(two + unicast + unicast, {"; and 1 more"});
    CHECK(notices_of(two + unicast + "hops = 1\n").empty());
    check_notice(two + "on_receive = { send = \"x\", to = \"sender\" }\n", {"sender", "one hop"});
    const TemporaryFolder folder;
    CHECK(error_of([&] {
              loaded(folder, two + unicast + "hops = 2\n");
          }).find("hops: found the number 2; expected a value of 1: over one hop") !=
          std::string::npos);
    const Scenario scenario = loaded(folder, two + unicast + "hops = 1\n");
    CHECK(scenario.traffic[0].hops == 1);
    CHECK(to_toml(to_document(scenario)).find("hops = 1\n") != std::string::npos);
}

TEST_CASE(
    "unlikely input: a robot that is switched on while it is on, or off while it is off, gives a "
    "notice") {
    check_notice(robot_a + "on = [\"1 s\"]\noff = [\"5 s\"]\n",
                 {":4:6: on: ", "already on at 1 s"});
    check_notice(robot_a + "off = [\"1 s\", \"2 s\"]\n", {":4:7: off: ", "already off at 2 s"});
}

TEST_CASE(
    "unlikely input: if a movement file overrides keys for the motion of robots, one notice says "
    "so") {
    const TemporaryFolder folder;
    folder.write("m.tcl", "$node_(0) set X_ 1\n$node_(1) set X_ 2\n");
    const std::string head = "[movement]\nfile = \"m.tcl\"\n[[robot]]\nname = \"n0\"\n";
    const std::string at = "at = [\"2 m\", \"2 m\"]\n";
    const std::string move = "move = { model = \"goal\", to = [\"6 m\", \"2 m\"] }\n";
    const auto notices = [&](const std::string& keys) {
        return loaded(folder, head + keys).notices;
    };
    const std::string file = folder.path("s.toml"), why = " has no effect on robot \"n0\": the ";
    REQUIRE(notices(at).size() == 1);
    CHECK(notices(at)[0].starts_with(file + ":5:6: the key \"at\"" + why));
    CHECK(notices(move)[0].starts_with(file + ":5:8: the key \"move\"" + why));
    CHECK(notices("place = { model = \"choice\", points = [[\"2 m\", \"2 m\"]] }\n")[0].starts_with(
        file + ":5:9: the key \"place\"" + why));
    CHECK(notices(at + move + "[[robot]]\nname = \"n1\"\n" + at)[0].ends_with(
        "and 2 more like this"));
    CHECK(notices("radius = \"1 m\"\nmove = { model = \"fixed\" }\n").empty());
    CHECK(notices("[[robot]]\nname = \"own\"\n" + at).empty());
}

TEST_CASE("unlikely input: robots that start off the map give one notice") {
    check_notice(on_map + "[[robot]]\nname = \"A\"\nat = [\"448 m\", \"0.5 m\"]\n",
                 {":6:6: robot \"A\" starts at (448, 0.5) m, 440 m off the map", "(8, 1) m"});
    const std::string two =
        "[[robot]]\nname = \"B\"\nplace = { area = [[\"0 m\", \"0 m\"], [\"9 m\", \"1 m\"]] }\n"
        "radius = \"0 m\"\n[[robot]]\nname = \"C\"\nat = [\"9 m\", \"9 m\"]\n";
    check_notice(on_map + two, {"robot \"B\"", "1 m off the map", "and 1 more"});
}

TEST_CASE(
    "unlikely input: with the model `rays`, a wall 1 m thick without a material gives a notice") {
    const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"0.5 m\"]\n";
    const std::string rays = "[propagation]\nmodel = \"rays\"\n";
    check_notice(
        on_map + robot + rays,
        {":7:1: the wall drawn at x = ",
         "thicker than 0.5 m (thickest wall without a material in this scene: 1 m", "0.5 m thick"});
    CHECK(notices_of(on_map + robot).empty());
    CHECK(notices_of(robot + rays).empty());
    const std::string given =
        "[scene.materials]\nshelf = { greys = [0, 100], per_crossing = \"3 dB\" }\n";
    CHECK(notices_of(on_map + given + robot + rays).empty());
}

TEST_CASE(
    "unlikely input: with the model multi_wall, a thick wall without a material gives a notice") {
    // A block 0.9 m thick in cells of 10 cm; on_map has cells of 1 m, and no thinner walls.
    const TemporaryFolder folder;
    test::PngPicture picture{.width = 40, .height = 20, .rows = {}};
    picture.rows.assign(20, std::vector<std::uint8_t>(40, 255));
    for (auto& row : picture.rows) std::fill(row.begin() + 20, row.begin() + 29, std::uint8_t{0});
    folder.write("block.png", test::png_bytes(picture));
    const std::string map = "[scene]\nmap = \"block.png\"\nsize = [\"4 m\", \"2 m\"]\n";
    const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"1 m\"]\n";
    const std::string walls = "model = \"multi_wall\"\n";
    const auto notices = [&](const std::string& text) { return loaded(folder, text).notices; };
    const auto noticed =
        notices(map + robot + "[propagation]\n" + walls + "heavy_wall = \"9 dB\"\n");
    REQUIRE(noticed.size() == 1);
    CAPTURE(noticed[0]);
    for (const char* part : {":7:1: the wall drawn at x = ", "is thicker than 0.8 m",
                             "(thickest wall without a material in this scene: 0.9 m)",
                             "one wall of 9 dB, however thick"})
        CHECK(noticed[0].find(part) != std::string::npos);
    const std::string own = "propagation = { model = \"multi_wall\" }\n";
    const auto of_robot = notices(map + robot + own);
    REQUIRE(of_robot.size() == 1);
    CHECK(of_robot[0].find(":7:15: the wall drawn") != std::string::npos);
    const std::string given =
        "[scene.materials]\nshelf = { greys = [0, 100], per_crossing = \"3 dB\" }\n";
    CHECK(notices(map + given + robot + own).empty());
    CHECK(notices(robot + own).empty());
    CHECK(notices_of(on_map + "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"0.5 m\"]\n" + own)
              .empty());
}

TEST_CASE(
    "unlikely input: with a map, a coefficient N that already includes the loss of walls gives a "
    "notice") {
    const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"0.5 m\"]\n";
    const std::string own = "propagation = { model = \"raytrace_2007\" }\n";
    const std::string rays = "[propagation]\nmodel = \"raytrace_2007\"\n";
    check_notice(on_map + robot + rays,
                 {":7:1: coefficient: N = 30 of raytrace_2007 already includes",
                  "did you mean coefficient = 20?"});
    check_notice(on_map + robot + rays + "coefficient = 22.5\n", {"N = 22.5"});
    check_notice(on_map + robot + own, {":7:15: coefficient: N = 30"});
    CHECK(notices_of(on_map + robot + rays + "coefficient = 22\n").empty());
    CHECK(notices_of(robot + rays).empty());  // an open field
    CHECK(notices_of(on_map + robot + "[propagation]\nmodel = \"itu_indoor\"\n").empty());
    // [propagation] rules nobody where all robots have a model of their own.
    CHECK(notices_of(on_map + robot + "propagation = { model = \"friis\" }\n" + rays).empty());
}

TEST_CASE("unlikely input: a material whose pixels are not walls gives a notice") {
    const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"0.5 m\"]\n";
    check_notice(
        on_map + robot + "[scene.materials]\npane = { grey = 140, per_crossing = \"3 dB\" }\n",
        {":8:1: material \"pane\": 1 of its 1 pixels in m.png are not walls"});
    check_notice(on_map + robot + "[scene.materials]\nx = { grey = 7, per_crossing = \"3 dB\" }\n",
                 {"material \"x\" matches no pixel of m.png"});
    check_notice(
        on_map + robot + "[scene.materials]\nx = { color = \"red\", per_crossing = \"3 dB\" }\n",
        {"material \"x\" is not used: in a map"});
    CHECK(notices_of(on_map + robot +
                     "[scene.materials]\nx = { grey = 100, per_crossing = \"3 dB\" }\n")
              .empty());
}

TEST_CASE(
    "unlikely input: if pixels of a material are not walls by the thresholds of a ROS map, a "
    "notice says so") {
    const TemporaryFolder folder;
    const test::PngPicture picture{.width = 4, .height = 1, .rows = {{255, 0, 120, 255}}};
    folder.write("m.png", test::png_bytes(picture));
    folder.write("m.yaml",
                 "image: m.png\nresolution: 1\norigin: [0, 0, 0]\noccupied_thresh: 0.65\n"
                 "free_thresh: 0.25\n");
    const Scenario s = loaded(folder,
                              "[scene]\nmap = \"m.yaml\"\n[scene.materials]\n"
                              "brick = { greys = [0, 130], per_crossing = \"9 dB\" }\n"
                              "[[robot]]\nname = \"A\"\nat = [\"0.5 m\", \"0.5 m\"]\n");
    REQUIRE(s.notices.size() == 1);
    CHECK(s.notices[0].find("1 of its 2 pixels in m.yaml are not walls") != std::string::npos);
    CHECK(s.notices[0].find("occupied_thresh") != std::string::npos);
}

TEST_CASE(
    "unlikely input: a robot in a wall of a Stage world gives a notice, because Stage allows it") {
    const TemporaryFolder folder;
    const std::string world =
        folder.write("w.world",
                     "model ( name \"block\" size [2 2] pose [0 0 0] )\n"
                     "position ( name \"r\" pose [0.5 0 0] wifi ( model \"friis\" ) )\n");
    const std::string over = folder.write("s.toml",
                                          "[scene]\nworld = \"w.world\"\n[[robot]]\nname = \"r\"\n"
                                          "at = [\"0.5 m\", \"0 m\"]\n");
    for (const std::string& file : {world, over}) {
        const Scenario scenario = load_scenario(file, {});
        Network network(network_settings(scenario));
        populate(network, scenario);
        CHECK(std::count_if(scenario.notices.begin(), scenario.notices.end(), [](const auto& text) {
                  return text.find("robot \"r\" at (0.5, 0) m is inside a wall") != text.npos;
              }) == 1);
    }
}

TEST_CASE(
    "unlikely input: if a robot's clearance is slightly below its radius, the error has enough "
    "digits to show it") {
    const TemporaryFolder folder;
    folder.write("wall.png",
                 test::png_bytes({.width = 4, .height = 1, .rows = {{0, 255, 255, 255}}}));
    const std::string refused = error_of([&] {
        const Scenario s = load_scenario(folder.write("s.toml", R"([scene]
map = "wall.png"
size = ["4 m", "1 m"]
[[robot]]
name = "r"
at = ["1.00996 m", "0.5 m"]
radius = "0.01 m"
)"),
                                         {});
        Network network(network_settings(s));
        populate(network, s);
    });
    CAPTURE(refused);
    CHECK(refused.find("its radius of 0.01 m (clearance 0.00996 m)") != std::string::npos);
}

TEST_CASE(
    "unlikely input: a robot with its own propagation model takes no parameters from "
    "[propagation]") {
    const TemporaryFolder folder;
    const auto loss = [&](const std::string& own) {
        const Scenario s = loaded(folder,
                                  "[propagation]\nmodel = \"raytrace_2007\"\ncoefficient = 20\n"
                                  "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n" +
                                      own + "[[robot]]\nname = \"B\"\nat = [\"10 m\", \"0 m\"]\n");
        CHECK(s.robots[0].own_model == (own.find("model") != own.npos));
        return report_link(s, "A", "B", start_of_run).path_loss.value;
    };
    const double office =
        loss("propagation = { model = \"itu_indoor\", environment = \"office\" }\n");
    CHECK(office - loss("") == doctest::Approx(10).epsilon(1e-9));  // 30 and 20, over ten metres
    // Without a model of its own, what it does not say is the scenario's.
    CHECK(loss("propagation = { wall_factor = 3 }\n") == loss(""));
    CHECK(loss("propagation = { coefficient = 30 }\n") == office);
}

TEST_CASE(
    "unlikely input: the protocol `managed`, used with a model without levels such as `disc`, "
    "gives a notice") {
    const std::string disc = "{ model = \"disc\", range = \"9 m\" }\n";
    const std::string managed = "[routing]\nprotocol = \"managed\"\n";
    const std::string robot_b = "[[robot]]\nname = \"B\"\nat = [\"3 m\", \"2 m\"]\n";
    const std::string notice =
        "model: \"disc\" computes no received levels, so under [routing] protocol = \"managed\" a "
        "robot's delay before it relays a message does not depend on the received level; expected "
        "a different model, such as \"friis\"";
    check_notice("propagation = " + disc + managed + robot_a, {"s.toml:1:15: " + notice});
    check_notice(managed + robot_a + "propagation = " + disc + robot_b, {"s.toml:6:15: " + notice});
    CHECK(notices_of("propagation = " + disc + robot_a).empty());
    CHECK(notices_of(managed + robot_a).empty());
    CHECK(notices_of("propagation = " + disc + managed + robot_a +
                     "propagation = { model = \"friis\" }\n")
              .empty());
}

TEST_CASE("memory: more robots than fit into memory are refused before any is created") {
    Scenario s;
    s.robots.resize(1);
    s.robots[0].name = "r";
    s.robots[0].count = 3'000'000;
    s.robots[0].where = {"s.toml", 1, 1};
    check_memory(s, 500'000'000'000);
    CHECK(s.notices.empty());  // 0.8 GB
    s.robots[0].count = 9'999'999;
    check_memory(s, 500'000'000'000);
    REQUIRE(s.notices.size() == 1);
    CHECK(s.notices[0] == "s.toml:1:1: the robots take about 2.8 GB of memory");
    const std::string refused = error_of([&] { check_memory(s, 2'000'000'000); });
    CHECK(refused ==
          "s.toml:1:1: count: the robots take about 2.8 GB of memory, but this process may use "
          "only 2.0 GB; expected fewer robots");
    CHECK(available_memory() > 100'000'000);
}

TEST_CASE(
    "unlikely input: sum = \"coherent\" in the model `rays` gives a notice for walls oblique to "
    "the map's grid") {
    // A wall of 30 cm through the middle of a room of 6 m, in cells of 5 cm.
    const auto room = [](double slope) {
        std::vector<std::string> rows(80, std::string(120, '.'));
        for (std::size_t row = 0; row < rows.size(); ++row) {
            const double middle = 40 + slope * static_cast<double>(row);
            for (std::size_t i = 0; i < rows[row].size(); ++i) {
                if (std::abs(static_cast<double>(i) - middle) < 3) rows[row][i] = '#';
            }
        }
        return Scene(test::drawn_map(rows, 0.05));
    };
    const auto notices = [](const std::string& sum, const Scene& scene) {
        const TemporaryFolder folder;
        Scenario scenario =
            loaded(folder, "[propagation]\nmodel = \"rays\"\nsum = \"" + sum + "\"\n" + robot_a);
        note_coherent_slants(scenario, &scene);
        return scenario.notices;
    };
    const auto noticed = notices("coherent", room(0.4));
    REQUIRE(noticed.size() == 1);
    CHECK(noticed[0].find("2 faces") != std::string::npos);
    CHECK(noticed[0].find("did you mean sum = \"power\"?") != std::string::npos);
    CHECK(notices("coherent", room(0)).empty());
    CHECK(notices("power", room(0.4)).empty());
}

TEST_CASE(
    "access: the key `eifs` accepts true instead of \"standard\" and false instead of \"none\"") {
    const TemporaryFolder folder;
    const auto csma = [&](const std::string& keys) {
        return *loaded(folder, "[access]\nmodel = \"csma\"\n" + keys + robot_a).access.as<Csma>();
    };
    CHECK(csma("").eifs == EifsRule::standard);
    CHECK(csma("eifs = true\n").eifs == EifsRule::standard);
    CHECK(csma("eifs = false\n").eifs == EifsRule::none);
    CHECK(csma("eifs = \"none\"\n").eifs == EifsRule::none);
    const Csma as_ns2 = csma("eifs = \"ns2\"\n");
    CHECK(as_ns2.eifs == EifsRule::ns2);
    CHECK(as_ns2.timing().cca_time == Duration{0});
    CHECK(as_ns2.timing().turnaround == Duration{0});
    CHECK(as_ns2.timing().cw_min == 30);
    CHECK(csma("eifs = \"ns2\"\ncw_min = 31\n").timing().cw_min == 31);
    const auto error = [&](const std::string& value) {
        return error_of([&] { csma("eifs = " + value + "\n"); });
    };
    CHECK(error("\"ns3\"").find("s.toml:3:8: ") != std::string::npos);
    // Words of which only the number differs mean different things.
    for (const char* other : {"\"ns3\"", "\"ns-3\"", "\"NS3\""}) {
        CAPTURE(other);
        CHECK(error(other).find("did you mean") == std::string::npos);
        CHECK(error(other).find(
                  "\"ns2\" (after each frame that was sensed but not decoded, as in ns-2.35)") !=
              std::string::npos);
    }
    CHECK(error("\"NS2\"").find("did you mean \"ns2\"?") != std::string::npos);
    CHECK(error("\"ns-2\"").find("did you mean \"ns2\"?") != std::string::npos);
    CHECK(error("3").find("one of \"standard\" (after a frame") != std::string::npos);
    for (const char* no : {"\"off\"", "\"no\"", "\"False\""})
        CHECK(error(no).find("did you mean \"none\"?") != std::string::npos);
    for (const char* yes : {"\"on\"", "\"true\"", "\"Yes\""})
        CHECK(error(yes).find("did you mean \"standard\"?") != std::string::npos);
    CHECK(error("off").find("s.toml:3:8: found off without quotes; did you mean false?") !=
          std::string::npos);
}

TEST_CASE("traffic: robots that send simultaneously give a notice if their frames collide") {
    const TemporaryFolder folder;
    const auto noted = [&](const std::string& head, const std::string& a, const std::string& b) {
        const std::string robots =
            "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
            "[[robot]]\nname = \"B\"\nat = [\"1 m\", \"0 m\"]\n";
        const std::string flow = "[[traffic]]\nsize = \"9 B\"\nfrom = ";
        const Scenario scenario =
            loaded(folder, head + robots + flow + "\"A\"\n" + a + flow + "\"B\"\n" + b);
        return std::ranges::count_if(scenario.notices, [](const std::string& text) {
            return text.find("send messages at the same times") != std::string::npos;
        });
    };
    const std::string csma = "[reception]\nmodel = \"collision\"\n[access]\nmodel = \"csma\"\n";
    const std::string aloha = "[reception]\nmodel = \"collision\"\n[access]\nmodel = \"aloha\"\n";
    const std::string each_second = "start = \"1 s\"\nevery = \"1 s\"\n",
                      later = "start = \"7 s\"\nevery = \"1 s\"\n",
                      between = "start = \"1.002 s\"\nevery = \"1 s\"\n",
                      to_b = "kind = \"unicast\"\nto = \"B\"\n",
                      to_a = "kind = \"unicast\"\nto = \"A\"\n";
    for (const std::string& head : {csma, aloha}) {
        CHECK(noted(head, each_second, each_second) == 1);
        CHECK(noted(head, each_second, later) == 1);
        CHECK(noted(head, each_second, between) == 0);
        CHECK(noted(head, "start = \"1 s\"\n", "start = \"1 s\"\n") == 1);
        CHECK(noted(head, "start = \"1 s\"\n", "start = \"2 s\"\n") == 0);
    }
    // csma repeats a unicast after a backoff, and may draw one before every frame.
    CHECK(noted(csma, to_b + each_second, to_a + each_second) == 0);
    CHECK(noted(aloha, to_b + each_second, to_a + each_second) == 1);
    CHECK(noted(csma + "immediate_access = false\n", each_second, each_second) == 0);
    CHECK(noted(csma + "eifs = \"ns2\"\n", each_second, each_second) == 0);
    CHECK(noted(csma + "eifs = \"ns2\"\nimmediate_access = true\n", each_second, each_second) == 1);
    CHECK(noted("[access]\nmodel = \"csma\"\n", each_second, each_second) == 0);  // no collisions
    // Within the time in which neither senses the other, or within a frame.
    CHECK(noted(csma, each_second, "start = \"1.00001 s\"\nevery = \"1 s\"\n") == 1);
    CHECK(noted(csma, each_second, "start = \"1.000017 s\"\nevery = \"1 s\"\n") == 1);
    CHECK(noted(csma, each_second, "start = \"1.000019 s\"\nevery = \"1 s\"\n") == 0);
    CHECK(noted(aloha, each_second, "start = \"1.0001 s\"\nevery = \"1 s\"\n") == 1);
    // Other periods; a unicast that is repeated still takes a broadcast with it.
    CHECK(noted(csma, each_second, "start = \"1 s\"\nevery = \"500 ms\"\n") == 1);
    CHECK(noted(csma, each_second, "start = \"1 s\"\nevery = \"1.5 s\"\n") == 1);
    CHECK(noted(csma, each_second, "start = \"1 s\"\nevery = \"1.01 s\"\n") == 0);
    CHECK(noted(csma, each_second, to_a + each_second) == 1);
    // One that has ended meets nobody.
    for (const char* end : {"count = 3\n", "stop = \"5 s\"\n"})
        CHECK(noted(csma, each_second + end, "start = \"5 s\"\nevery = \"1 s\"\n") == 0);
    CHECK(noted(csma, each_second + "stop = \"5.1 s\"\n", "start = \"5 s\"\nevery = \"1 s\"\n") ==
          0);
    CHECK(noted(csma, each_second + "count = 5\n", "start = \"5 s\"\n") == 1);
}

TEST_CASE(
    "scenario errors: a suggested value has the right type; the unknown model raytrace_2008 gets "
    "no suggestion") {
    const TemporaryFolder folder;
    const auto error = [&](const std::string& text) {
        return error_of([&] { loaded(folder, text + robot_a); });
    };
    const auto has = [&](const std::string& text, const std::string& part) {
        const std::string found = error(text);
        CAPTURE(found);
        CHECK(found.find(part) != std::string::npos);
    };
    for (const char* other : {"802.11n", "802.11"})
        CHECK(error(fmt::format("[access]\nstandard = \"{}\"\n", other)).find("did you mean") ==
              std::string::npos);
    has("[access]\nstandard = \"80211G\"\n", "did you mean \"802.11g\"?");
    for (const char* slip : {"raytrace_2070", "raytrace_207", "raytrace2007"})
        has(fmt::format("[propagation]\nmodel = \"{}\"\n", slip),
            "did you mean \"raytrace_2007\"?");
    CHECK(error("[propagation]\nmodel = \"raytrace_2008\"\n").find("did you mean") ==
          std::string::npos);
    has("[shadowing]\nmodel = \"off\"\n", "did you mean \"none\"?");
    has("[shadowing]\nmodel = false\n", "model: found false; expected one of ");
    has("[shadowing]\nmodel = false\n", "did you mean \"none\"?");
    has("[metrics]\nreach = \"on\"\n", "did you mean true, without quotes?");
    has("[metrics]\nreach = off\n", "s.toml:2:9: found off without quotes; did you mean false?");
    has("[access]\nmodel = csma\n", "found csma without quotes; did you mean \"csma\"?");
}

}  // namespace unlikely_test
