// SPDX-License-Identifier: MIT
// The key `scan` of a robot: what it says, what it refuses, and how it is printed.
#include "scenario/tables/scan_table.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>
#include <vector>

namespace scan_table_test {
using namespace rovernet;

namespace {

std::vector<Scanner> read(const std::string& scan) {
    return read_scanners(*parse_toml("scan = " + scan, "a.toml").table()->find("scan"));
}

/// The error's column and text; empty if there is none.
std::string mistake(const std::string& scan) {
    try {
        read(scan);
    } catch (const InputError& error) {
        return std::to_string(error.where().column) + ": " + error.message();
    }
    return "";
}

constexpr double degrees = std::numbers::pi / 180;

}  // namespace

TEST_CASE(
    "scan: a table gives one range finder, a list gives several range finders, each with its own "
    "position") {
    const auto one = read("{ beams = 5 }");
    REQUIRE(one.size() == 1);
    CHECK(one[0].finder.beams == 5);
    CHECK(one[0].name.empty());
    CHECK(one[0].at == Vec3{});
    CHECK_FALSE(one[0].is_ring());
    const auto two = read(
        "[{ kind = \"ranger\" }, { name = \"rear\", at = [\"-20 cm\", \"1 cm\"], heading = \"180 "
        "deg\", range = \"3 m\" }]");
    REQUIRE(two.size() == 2);
    CHECK(two[0].label() == "ranger");
    CHECK(two[1].label() == "rear");
    CHECK(two[1].at == Vec3{-0.2, 0.01});
    CHECK(two[1].heading.value == doctest::Approx(std::numbers::pi));
    CHECK(two[1].finder.range.value == 3);
    CHECK(read("[]").empty());
}

TEST_CASE(
    "scan: a ring of sensors has an angle for each beam, and optionally a position for each beam") {
    const auto ring = read(
        "{ kind = \"sonar\", angles = [\"90 deg\", \"-10 deg\"], places = [[\"0.1 m\", \"0.2 m\"], "
        "[\"0 m\", \"-0.2 m\"]] }");
    REQUIRE(ring.size() == 1);
    CHECK(ring[0].size() == 2);
    CHECK(ring[0].angles[1].value == doctest::Approx(-10 * degrees));
    CHECK(ring[0].places[0] == Vec3{0.1, 0.2});
    CHECK(read("{ kind = \"ranger\", angles = [\"0 deg\"] }")[0].places.empty());
}

TEST_CASE(
    "scan: several range finders of one kind get different names; equal given names are an error") {
    const auto scanners = read("[{}, {}, { kind = \"sonar\" }, {}]");
    REQUIRE(scanners.size() == 4);
    CHECK(scanners[0].label() == "laser");
    CHECK(scanners[1].label() == "laser1");
    CHECK(scanners[2].label() == "sonar");
    CHECK(scanners[3].label() == "laser2");
    CHECK(mistake("[{}, { name = \"laser\" }]") ==
          "22: scan: two range finders are named \"laser\"; expected a different name for each, "
          "such as name = \"rear\"");
    CHECK(mistake("[{ name = \"laser1\" }, {}]").starts_with("30: scan: two range finders"));
}

TEST_CASE("scan: an error in a range finder has the line and column of the wrong key") {
    CHECK(mistake("{ name = \"\" }").starts_with("17: name: found "));
    CHECK(mistake("{ name = \"a/b\" }").find("without dots, slashes") != std::string::npos);
    CHECK(mistake("{ at = \"1 m\" }").starts_with("15: at: found"));
    CHECK(mistake("{ angle = [] }").find("did you mean \"angles\"") != std::string::npos);
    CHECK(mistake("{ angles = [\"0 deg\"] }").starts_with("19: angles: the beams of a laser are"));
    CHECK(mistake("{ kind = \"sonar\", angles = [] }").starts_with("35: angles: found 0 angles"));
    CHECK(mistake("{ kind = \"sonar\", places = [] }").find("\"angles\" is missing") !=
          std::string::npos);
    CHECK(mistake("{ kind = \"sonar\", angles = [\"0 deg\"], places = [] }") ==
          "55: places: found 0 places; expected one place for each of the 1 `angles`");
    for (const char* key : {"beams = 3", "from = \"0 deg\"", "to = \"0 deg\""}) {
        CAPTURE(key);
        const std::string both =
            mistake("{ kind = \"sonar\", angles = [\"0 deg\"], " + std::string(key) + " }");
        CHECK(both.find("only one of them") != std::string::npos);
        CHECK(both.find("\"angles\"") != std::string::npos);
    }
    CHECK(mistake("[{ beams = 0 }]").starts_with("19: beams"));
    CHECK(mistake("[3]").find("a table") != std::string::npos);
}

TEST_CASE("scan: a printed range finder is read back unchanged") {
    const auto printed = [](const std::string& scan) {
        const std::string text =
            "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\nscan = " + scan + "\n";
        const std::string once =
            to_toml(to_document(read_scenario(parse_toml(text, "a.toml"), "a.toml")));
        const std::string twice =
            to_toml(to_document(read_scenario(parse_toml(once, "b.toml"), "b.toml")));
        CHECK(once == twice);
        const auto begin = once.find("\nscan = ");
        return begin == once.npos ? ""
                                  : once.substr(begin + 8, once.find('\n', begin + 1) - begin - 8);
    };
    CHECK(printed("{}") ==
          "{ kind = \"laser\", beams = 181, from = \"-90 deg\", to = \"90 deg\", range = \"8 m\", "
          "every = \"100 ms\" }");
    CHECK(printed("[{}]") == printed("{}"));
    CHECK(printed("[]").empty());
    CHECK(printed("[{ beams = 1 }, { beams = 2, name = \"rear\", at = [\"-0.2 m\", \"0 m\"] }]") ==
          "[{ kind = \"laser\", beams = 1, from = \"-90 deg\", to = \"90 deg\", range = \"8 m\", "
          "every = \"100 ms\" }, { kind = \"laser\", beams = 2, from = \"-90 deg\", to = \"90 "
          "deg\", range = \"8 m\", every = \"100 ms\", name = \"rear\", at = [\"-20 cm\", \"0 m\"] "
          "}]");
    CHECK(printed("{ kind = \"sonar\", angles = [\"90 deg\", \"0 deg\"], heading = \"1 deg\" }") ==
          "{ kind = \"sonar\", range = \"8 m\", every = \"100 ms\", heading = \"1 deg\", angles = "
          "[\"90 deg\", \"0 deg\"] }");
}

}  // namespace scan_table_test
