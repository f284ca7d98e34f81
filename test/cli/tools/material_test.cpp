// SPDX-License-Identifier: MIT
#include "test/cli/process.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace material_test {
using namespace rovernet;
using test::command;
using test::Ended;
using test::Json;
using test::TemporaryFolder;

namespace {

Ended material(std::vector<std::string> arguments) {
    static const TemporaryFolder folder;
    arguments.insert(arguments.begin(), "material");
    return command(folder, arguments);
}

bool near(const Json& value, double expected) {
    return std::abs(value.get<double>() - expected) <= 1e-8;  // the vectors' digits
}

}  // namespace

TEST_CASE("material: the losses of 20 cm of concrete equal the test vectors") {
    const Ended ended = material(
        {"concrete", "--thickness", "0.2", "--frequency", "2.4 GHz", "--angle", "30", "--json"});
    REQUIRE(ended.exit == 0);
    const Json json = Json::parse(ended.out);
    CHECK(near(json["te_transmission_loss_db"], 15.2530481377792));
    CHECK(near(json["tm_transmission_loss_db"], 14.4481824299186));
    CHECK(near(json["te_reflection_loss_db"], 7.20221080552597));
    CHECK(near(json["tm_reflection_loss_db"], 9.45673768031774));
    CHECK(json["material"] == "concrete");
    CHECK(json["thickness_m"] == 0.2);
    CHECK(json["frequency_hz"] == 2.4e9);
    CHECK(json["angle_deg"] == 30);
}

TEST_CASE("material: by default the wave is perpendicular to the wall, and has 2450 MHz") {
    const Json json = Json::parse(material({"brick", "--thickness", "10 cm", "--json"}).out);
    CHECK(json["frequency_hz"] == 2.45e9);
    CHECK(json["angle_deg"] == 0);
    CHECK(near(json["te_transmission_loss_db"], json["tm_transmission_loss_db"].get<double>()));
}

TEST_CASE(
    "material: the loss of a metre of metal is finite; an infinite reflection loss is null in "
    "JSON") {
    const Json metal = Json::parse(material({"metal", "--thickness", "1 m", "--json"}).out);
    CHECK(metal["te_transmission_loss_db"].get<double>() > 1e6);
    const Json film = Json::parse(material({"wood", "--thickness", "1e-200 m", "--json"}).out);
    CHECK(film["te_reflection_loss_db"].is_null());
    CHECK(film["te_transmission_loss_db"] == 0);
    CHECK(material({"wood", "--thickness", "1e-200 m"}).out.find("inf") != std::string::npos);
}

TEST_CASE("material: an error says what was found and what was expected") {
    const auto error = [](std::vector<std::string> arguments) {
        const Ended ended = material(std::move(arguments));
        CHECK(ended.exit == 2);
        CHECK(ended.out.empty());
        return ended.err;
    };
    const std::string names = R"("concrete", "brick", "plasterboard", "wood", "glass", )"
                              R"("ceiling_board", "chipboard", "plywood", "marble", )"
                              R"("floorboard", "metal")";
    CHECK(error({"concret", "--thickness", "0.2"}) ==
          "rovernet: material concret: unknown material \"concret\"; expected one of " + names +
              "; did you mean \"concrete\"?\n");
    CHECK(error({"brick", "--thickness", "0"}) ==
          "rovernet: --thickness 0: expected a thickness > 0\n");
    CHECK(error({"brick", "--thickness=-1"}) ==
          "rovernet: --thickness -1: expected a length >= 0\n");
    for (const std::string angle : {"90", "-1", "nan", "steep"}) {
        CHECK(error({"brick", "--thickness", "0.2", "--angle=" + angle}) ==
              "rovernet: --angle: found \"" + angle +
                  "\"; expected an angle to the normal from 0 to below 90 degrees; run with "
                  "--help for more\n");
    }
    CHECK(error({"brick"}) == "rovernet: --thickness is required; run with --help for more\n");
}

}  // namespace material_test
