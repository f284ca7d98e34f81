// SPDX-License-Identifier: MIT
// probe, as its user meets it.
#include "test/cli/process.hpp"
#include "test/scene/png_writer.hpp"
#include "test/scene/temporary_folder.hpp"
#include "test/study/small_scenarios.hpp"

#include <doctest/doctest.h>

#include <string>

namespace probe_test {
using namespace rovernet::test;

namespace {

/// B at the rim of a disc.
const std::string rim = two_robots(10, disc);

/// 16 x 8 cells with a wall of three columns, in the scenario's folder.
std::string with_map(const TemporaryFolder& folder) {
    PngPicture picture{.width = 16, .height = 8, .rows = {}};
    for (int row = 0; row < 8; ++row) {
        picture.rows.push_back(
            {255, 255, 255, 255, 255, 255, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255});
    }
    folder.write("wall.png", png_bytes(picture));
    return folder.write("wall.toml", R"([scenario]
duration = "2 s"
[scene]
map = "wall.png"
size = ["16 m", "8 m"]
[propagation]
model = "raytrace_2007"
wall_factor = 0.01
[[robot]]
name = "A"
at = ["2 m", "4.5 m"]
[[robot]]
name = "B"
at = ["14 m", "4.5 m"]
)");
}

}  // namespace

TEST_CASE(
    "probe: with the model `disc`, an affected link is printed with its distance, without levels") {
    const TemporaryFolder folder;
    const Ended ended = command(folder, {"probe", folder.write("rim.toml", rim)});
    CHECK(ended.exit == 0);
    CHECK(ended.err.empty());
    CHECK(ended.out.starts_with(
        "1 links at 20 times, losses computed by disc; 4 receptions of messages"));
    CHECK(ended.out.find("up -> down") != std::string::npos);
    CHECK(ended.out.find("2 cliffs") != std::string::npos);
    CHECK(ended.out.find("1 um north of the sender") != std::string::npos);
    // A disc has no levels: links are told by their distance.
    CHECK(ended.out.find(" dB ") == ended.out.find(" dB per mm), then"));
    CHECK(ended.out.find("10 m") != std::string::npos);
    const Json all = json_of(folder, {"probe", folder.path("rim.toml")});
    CHECK(all["perturbations"][0]["worst_db"].is_null());
    CHECK(all["effects"][0]["change_db"].is_null());
    CHECK(all["effects"][0]["distance_m"] == 10);
}

TEST_CASE("probe: the JSON output lists the perturbations of a map, and at most --top effects") {
    const TemporaryFolder folder;
    const Json all = json_of(folder, {"probe", with_map(folder)});
    CHECK(all["model"] == "raytrace_2007");
    CHECK(all["perturbations"].size() == 8);
    CHECK(all["perturbations"][2]["name"] == "resolution x2");
    CHECK(all["perturbations"][2]["changed"] == 0);
    CHECK(all["perturbations"][4]["name"] == "walls outlined");
    CHECK(all["perturbations"][4]["worst_db"].get<double>() < -0.9);  // 1 of 3 m, 1 dB each
    CHECK(all["perturbations"][5]["nothing"] == "no wall is hollow");
    CHECK(all["effects"].size() > 1);
    CHECK(all["effects"][0]["db_per_mm"].is_null());
    const Json one = json_of(folder, {"probe", with_map(folder), "--top", "1", "--no-messages"});
    CHECK(one["effects"].size() == 1);
    CHECK(one["messages"].empty());
}

TEST_CASE("probe: robots that never come into range, and the option --links 0, are refused") {
    const TemporaryFolder folder;
    const std::string file = folder.write("rim.toml", rim);
    const Ended alone = command(folder, {"probe", file, "--set", "propagation.range=\"1 m\""});
    CHECK(alone.exit == 3);
    CHECK(alone.err.find("according to the propagation model disc, no two robots come within range "
                         "of each other") != std::string::npos);
    CHECK(command(folder, {"probe", file, "--links", "0"}).exit == 2);
}

}  // namespace probe_test
