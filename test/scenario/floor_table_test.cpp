// SPDX-License-Identifier: MIT
// [[scene.floor]]: buildings of several storeys as scenarios give them.
#include "experiment/build.hpp"
#include "experiment/reports/link_report.hpp"
#include "experiment/reports/network_at.hpp"
#include "experiment/run.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

namespace floor_table_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

constexpr double rounding_db = 1e-9;

bool near(double a, double b, double within = rounding_db) { return std::abs(a - b) <= within; }

/// A row of pixels of 1 m.
std::string picture(const std::vector<png_byte>& row) {
    return test::png_bytes({.width = static_cast<png_uint_32>(row.size()), .rows = {row}});
}

/// Black at x = 3 below, grey 100 at x = 6 above.
struct Building {
    TemporaryFolder folder;
    Building() {
        folder.write("ground.png", picture({255, 255, 255, 0, 255, 255, 255, 255, 255, 255}));
        folder.write("upper.png", picture({255, 255, 255, 255, 255, 255, 100, 255, 255, 255}));
        folder.write("small.yaml",
                     "image: upper.png\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
                     "occupied_thresh: 0.5\nfree_thresh: 0.2\n");
    }
    Scenario scenario(const std::string& text, const std::vector<std::string>& set = {}) const {
        return load_scenario(folder.write("s.toml", text), {.set = set});
    }
};

std::string ground(const std::string& more = "") {
    return "[[scene.floor]]\nheight = \"0 m\"\nmap = \"ground.png\"\nsize = [\"10 m\", \"1 m\"]\n" +
           more;
}
std::string upper(const std::string& more = "") {
    return "[[scene.floor]]\nheight = \"3 m\"\nmap = \"upper.png\"\nsize = [\"10 m\", \"1 m\"]\n" +
           more;
}

/// Two robots in the plan's middle row, whose antennas are 1 m above the floors.
const std::string robots = R"([[robot]]
name = "a"
at = ["0.5 m", "0.5 m"]
radius = "0 m"
[[robot]]
name = "b"
at = ["9.5 m", "0.5 m", "3 m"]
radius = "0 m"
)";

double path_loss(const Scenario& scenario) {
    return report_link(scenario, "a", "b", start_of_run).path_loss.value;
}

struct Mistake {
    std::string text;
    std::string place;  // "line:column"
    std::vector<std::string> words;
};

}  // namespace

TEST_CASE("floors: walls of each storey and the ceiling attenuate a link") {
    const Building building;
    // From (0.5, 1) to (9.5, 4): it passes the ceiling at x = 6.5, after half of the upper wall,
    // which it only meets below. So the lower pillar counts, and the last half of the upper one.
    const std::string model = "[propagation]\nmodel = \"multi_wall\"\n";
    const double d = std::sqrt(81 + 9.0);
    const auto free = [&] {
        return 20 * std::log10(4 * 3.14159265358979323846 * d * 2450e6 / 299792458.0);
    }();
    const Scenario by_model = building.scenario(ground() + upper() + model + robots);
    CHECK(near(path_loss(by_model), free + 2 * 6.9 + 18.3, 1e-6));
    const auto own = "ceiling = { per_crossing = \"15 dB\" }\n";
    const Scenario by_ceiling = building.scenario(ground(own) + upper() + model + robots);
    CHECK(near(path_loss(by_ceiling), free + 2 * 6.9 + 15, 1e-6));
    const LinkReport link = report_link(by_ceiling, "b", "a", start_of_run);
    CHECK(link.walls.size() == 2);
    CHECK(link.ceilings == 1);
    CHECK(near(link.ceiling_loss.value, 15));
    CHECK(near(link.wall_losses[0].value + link.wall_losses[1].value, 2 * 6.9));
    const Scenario friis =
        building.scenario(ground(own) + upper() + robots, {"propagation.model=friis"});
    CHECK(near(path_loss(friis), free, 1e-6));
    CHECK(report_link(friis, "a", "b", start_of_run).ceiling_loss.value == 0);
}

TEST_CASE("floors: the report of a link states how many floors the model counts, and their loss") {
    const Building building;
    const std::string high =
        "[[robot]]\nname = \"a\"\nat = [\"0 m\", \"0 m\"]\n"
        "radio = { antenna_height = \"6 m\" }\n"
        "[[robot]]\nname = \"b\"\nat = [\"9 m\", \"0 m\"]\n";
    const std::string model = "[propagation]\nmodel = \"multi_wall\"\n";
    const std::string itu = "[propagation]\nmodel = \"itu_indoor\"\nenvironment = \"office\"\n";
    const auto link = [&](const std::string& text) {
        return report_link(building.scenario(text), "a", "b", start_of_run);
    };
    const LinkReport none = link(model + high);
    CHECK(none.floors == 0);
    CHECK(none.floor_loss.value == 0);
    const std::string storeys = "[scene]\nfloor_height = \"3 m\"\n";
    const LinkReport two = link(storeys + model + high);
    CHECK(two.floors == 2);
    CHECK(two.ceilings == 0);
    CHECK(near(two.floor_loss.value, two.path_loss.value - none.path_loss.value));
    CHECK(link(storeys + itu + high).floors == 2);
    CHECK(near(link(storeys + itu + high).floor_loss.value, 14));
    const LinkReport asked = link(itu + "floors = 1\n" + high);
    CHECK(asked.floors == 1);
    CHECK(near(asked.floor_loss.value, 14));
    const auto own = "ceiling = { per_crossing = \"15 dB\" }\n";
    const LinkReport building_link = link(ground(own) + upper() + model + robots);
    // A ceiling with a loss of its own is no floor of the model.
    CHECK(building_link.ceilings == 1);
    CHECK(near(building_link.ceiling_loss.value, 15));
    CHECK(building_link.floors == 0);
    CHECK(building_link.floor_loss.value == 0);
    const LinkReport by_model = link(ground() + upper() + model + robots);
    CHECK(by_model.ceilings == 1);
    CHECK(by_model.floors == 1);
    CHECK(near(by_model.floor_loss.value, 18.3));
    CHECK(near(by_model.ceiling_loss.value, 18.3));
}

TEST_CASE("floors: an antenna whose height puts it on a different storey gives a notice") {
    const Building building;
    const auto notices = [&](const std::string& text) { return building.scenario(text).notices; };
    const auto robot = [](const char* z, const char* antenna) {
        return fmt::format(
            "[[robot]]\nname = \"AP\"\nat = [\"0.5 m\", \"0.5 m\", \"{}\"]\n"
            "radio = {{ antenna_height = \"{}\" }}\n",
            z, antenna);
    };
    const auto told = notices(ground() + upper() + robot("0 m", "3.2 m"));
    REQUIRE(told.size() == 1);
    for (const char* word : {"s.toml:12:9", "\"AP\"", "3.2 m", "1 storey higher", "antenna_height"})
        CHECK(told[0].find(word) != std::string::npos);
    CHECK(notices(ground() + upper() + robot("0 m", "2.5 m")).empty());
    CHECK(notices(ground() + upper() + robot("3 m", "3.2 m")).empty());
    CHECK(notices(ground() + upper() + robot("3 m", "-0.5 m")).size() == 1);
    CHECK(notices("[scene]\nfloor_height = \"3 m\"\n" + robot("0 m", "3 m")).size() == 1);
    CHECK(notices(robot("0 m", "3 m")).empty());
}

TEST_CASE("floors: a ceiling may be a slab of a material of ITU-R P.2040") {
    const Building building;
    const std::string model = "[propagation]\nmodel = \"multi_wall\"\n";
    const auto loss = [&](const std::string& ceiling) {
        return path_loss(building.scenario(ground(ceiling) + upper() + model + robots));
    };
    const double slab = slab_loss(ItuMaterial::concrete, {0.2}, 2450_MHz).value;
    CHECK(near(loss("ceiling = { itu = \"concrete\", thickness = \"0.2 m\" }\n") -
                   loss("ceiling = { per_crossing = \"0 dB\" }\n"),
               slab));
}

TEST_CASE(
    "floors: materials of the scenario apply to all maps; materials of a file beside a map apply "
    "only to this map") {
    const Building building;
    const std::string model = "[propagation]\nmodel = \"multi_wall\"\n";
    const std::string shared =
        "[scene.materials]\nbrick = { grey = 0, per_crossing = \"9 dB\" }\n"
        "wood = { grey = 100, per_crossing = \"2 dB\" }\n";
    const double plain = path_loss(building.scenario(ground() + upper() + model + robots));
    CHECK(near(path_loss(building.scenario(ground() + upper() + shared + model + robots)),
               plain - 2 * 6.9 + 9 + 2));
    // Grey 0 below is a material of the upper map's file, which it is not looked up in.
    building.folder.write("upper.materials.toml",
                          "[tin]\ngrey = 0\nper_crossing = \"30 dB\"\n"
                          "[wood]\ngrey = 100\nper_crossing = \"4 dB\"\n");
    const Scenario sidecar = building.scenario(ground() + upper() + model + robots);
    CHECK(near(path_loss(sidecar), plain - 6.9 + 4));
    REQUIRE(sidecar.notices.size() == 1);
    CHECK(sidecar.notices[0].find("material \"tin\" matches no pixel of upper.png") !=
          std::string::npos);
}

TEST_CASE(
    "floors: the size of a storey may come from its map.yaml, and wall_height is measured from "
    "each floor") {
    const Building building;
    const std::string yaml = "[[scene.floor]]\nheight = \"3 m\"\nmap = \"small.yaml\"\n";
    const Scenario low = building.scenario("[scene]\nwall_height = \"50 cm\"\n" + ground() + yaml +
                                           "[propagation]\nmodel = \"multi_wall\"\n" + robots);
    // It passes above the lower wall, and through the upper one just above its floor.
    CHECK(report_link(low, "a", "b", start_of_run).walls.size() == 1);
    CHECK(low.walls->storeys().size() == 2);
    CHECK(low.walls->crossings({0, 0.5, 3.4}, {9, 0.5, 3.4}).size() == 1);
    CHECK(low.walls->crossings({0, 0.5, 3.6}, {9, 0.5, 3.6}).empty());
}

TEST_CASE("floors: printed storeys are read back unchanged, and --set can change a single storey") {
    const Building building;
    const std::string text =
        ground("ceiling = { per_crossing = \"15 dB\" }\n") +
        upper("ceiling = { itu = \"concrete\", thickness = \"0.2 m\" }\n") +
        "[[scene.floor]]\nheight = \"6 m\"\nmap = \"upper.png\"\nsize = [\"10 m\", \"1 m\"]\n" +
        robots;
    const Scenario first = building.scenario(text);
    const std::string printed = to_toml(to_document(first));
    CHECK(printed.find("floor_height") == std::string::npos);
    CHECK(to_toml(to_document(building.scenario(printed))) == printed);
    CHECK(first.scene.floors.size() == 3);
    CHECK(*first.scene.floors[1].ceiling->itu == ItuMaterial::concrete);
    const Scenario higher = building.scenario(text, {"scene.floor.2.height=7 m"});
    CHECK(higher.walls->storeys().floor(2) == 7);
}

TEST_CASE("floors: an error in a storey is reported with line, column and what was expected") {
    const Building building;
    const std::string map_and = "[scene]\nmap = \"ground.png\"\nsize = [\"10 m\", \"1 m\"]\n";
    const std::vector<Mistake> mistakes{
        {"[scene]\nfloor = 3\n", "2:9", {"[[scene.floor]]"}},
        {"[scene.floor]\nheight = \"0 m\"\n", "1:1", {"[[scene.floor]]"}},
        {"[[scene.floor]]\nheight = \"0 m\"\n", "1:1", {"\"map\" is missing"}},
        {"[[scene.floor]]\nmap = \"ground.png\"\n", "1:1", {"\"height\" is missing"}},
        {"[[scene.floor]]\nhieght = \"0 m\"\nmap = \"ground.png\"\n",
         "2:1",
         {"unknown key \"hieght\"", "did you mean \"height\"?"}},
        {"[[scene.floor]]\nheight = \"0 m\"\nmap = \"ground.png\"\n", "3:7", {"without a scale"}},
        {"[[scene.floor]]\nheight = \"0 m\"\nmap = \"none.png\"\n", "3:7", {"none.png"}},
        {"[[scene.floor]]\nheight = \"0\"\nmap = \"ground.png\"\n", "2:10", {"height", "m"}},
        {"[[scene.floor]]\nheight = \"0 m\"\nmap = \"ground.png\"\nsize = [\"1 m\"]\n",
         "4:8",
         {"a width and a height"}},
        {"[[scene.floor]]\nheight = \"0 m\"\nmap = \"small.yaml\"\nsize = [\"1 m\", \"1 m\"]\n",
         "3:7",
         {"the size of the map"}},
        {upper() + ground(), "6:10", {"found 0 m", "at 3 m", "from the lowest to the highest"}},
        {ground() + ground(), "6:10", {"found 0 m", "from the lowest to the highest"}},
        {ground() + upper("ceiling = { per_crossing = \"9 dB\" }\n"), "9:11", {"highest floor"}},
        {ground("ceiling = { per_crossing = \"-9 dB\" }\n") + upper(), "5:28", {">= 0"}},
        {ground("ceiling = { itu = \"concrete\" }\n") + upper(), "5:11", {"thickness"}},
        {ground("ceiling = { thickness = \"1 m\" }\n") + upper(), "5:11", {"itu"}},
        {ground("ceiling = { itu = \"concret\", thickness = \"1 m\" }\n") + upper(),
         "5:19",
         {"did you mean \"concrete\"?"}},
        {ground("ceiling = { loss = \"9 dB\" }\n") + upper(), "5:13", {"unknown key \"loss\""}},
        {map_and + ground(), "2:7", {"both \"floor\" and \"map\""}},
        {"[scene]\nfloor_height = \"3 m\"\n" + ground(), "2:16", {"\"floor_height\""}},
        {ground() + upper() + "[propagation]\nmodel = \"rays\"\n",
         "9:1",
         {"rays", "2 storeys", "multi_wall"}},
    };
    for (const Mistake& mistake : mistakes) {
        CAPTURE(mistake.text);
        std::string message;
        try {
            network_at(building.scenario(mistake.text + robots), start_of_run);
        } catch (const InputError& error) {
            message = error.what();
        }
        CAPTURE(message);
        CHECK(message.find(fmt::format("s.toml:{}: ", mistake.place)) != std::string::npos);
        for (const std::string& word : mistake.words)
            CHECK(message.find(word) != std::string::npos);
    }
}

TEST_CASE(
    "floors: a robot in a wall, a goal off the map and a goal without stairs to it are errors") {
    const Building building;
    const std::string scene = ground() + upper();
    const auto error_of = [&](const std::string& robot) -> std::string {
        try {
            network_at(
                building.scenario(scene + "[[robot]]\nname = \"r\"\nradius = \"10 cm\"\n" + robot),
                start_of_run);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const auto has = [](const std::string& text, const char* word) {
        return text.find(word) != std::string::npos;
    };
    CHECK(error_of("at = [\"3.5 m\", \"0.5 m\", \"3 m\"]\n") == "");
    const std::string in_wall = error_of("at = [\"6.5 m\", \"0.5 m\", \"3 m\"]\n");
    CHECK(has(in_wall, "s.toml:12:6"));
    CHECK(has(in_wall, "(6.5, 0.5, 3) m is inside a wall"));
    const std::string start = "at = [\"0.5 m\", \"0.5 m\"]\n";
    const auto to = [&](const char* place) {
        return error_of(start + "move = { model = \"goal\", to = " + place + " }\n");
    };
    CHECK(to("[\"2 m\", \"0.5 m\", \"3 m\"]") == "");
    const std::string blocked = to("[\"5 m\", \"0.5 m\", \"3 m\"]");
    CHECK(has(blocked, "s.toml:13:8"));
    CHECK(has(blocked, "no stairs from (0.5, 0.5) m to (5, 0.5, 3) m"));
    CHECK(has(to("[\"50 m\", \"0.5 m\", \"3 m\"]"), "off the map"));
}

}  // namespace floor_table_test
