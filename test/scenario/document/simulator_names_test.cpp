// SPDX-License-Identifier: MIT
#include "scenario/document/simulator_names.hpp"

#include "scenario/document/toml.hpp"
#include "scenario/model_names.hpp"
#include "scenario/scenario.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace simulator_names_test {
using namespace rovernet;

namespace {

/// Names of a table of the scenario file, such as "routing".
std::vector<std::string> choices(std::string_view table) {
    const Table all = model_names();
    std::vector<std::string> names;
    for (const Value& each : *all.find(table)->array()) names.push_back(*each.string());
    return names;
}

std::string hint(std::string_view table, std::string_view word) {
    return simulator_name_hint(word, choices(table));
}

std::string meant(std::string_view name) { return "did you mean \"" + std::string(name) + "\"?"; }

std::string error_of(const std::string& keys) {
    try {
        read_scenario(
            parse_toml("robot = [{ name = \"A\", at = [\"0 m\", \"0 m\"] }]\n" + keys, "s.toml"),
            "s.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a model name of ns-2 gets a hint with the name that scenario files use") {
    CHECK(hint("propagation", "FreeSpace") == meant("friis"));
    CHECK(hint("propagation", "Propagation/FreeSpace") == meant("friis"));
    CHECK(hint("propagation", "TwoRayGround") == meant("two_ray"));
    CHECK(hint("propagation", "TwoRay") == meant("two_ray"));
    CHECK(hint("propagation", "Shadowing") ==
          "did you mean \"log_distance\", with exponent and sigma?");
    CHECK(hint("access", "Mac/802_11") == meant("csma"));
    CHECK(hint("routing", "AODV") == meant("aodv"));
    CHECK(hint("routing", "DSR") == meant("dsr"));
}

TEST_CASE(
    "a class name of ns-3 or OMNeT++ gets a hint with the model name that scenario files use") {
    CHECK(hint("propagation", "FriisPropagationLossModel") == meant("friis"));
    CHECK(hint("propagation", "ns3::LogDistancePropagationLossModel") == meant("log_distance"));
    CHECK(hint("propagation", "RangePropagationLossModel") == meant("disc"));
    CHECK(hint("propagation", "FreeSpacePathLoss") == meant("friis"));
    CHECK(hint("propagation", "UnitDiskRadioMedium") == meant("disc"));
    CHECK(hint("propagation", "NakagamiPropagationLossModel") ==
          "did you mean [fading] model = \"nakagami\"?");
    CHECK(hint("propagation", "RicianFading") == "did you mean [fading] model = \"rician\"?");
    CHECK(hint("access", "ns3::AdhocWifiMac") == meant("csma"));
    CHECK(hint("access", "Ieee80211Mac") == meant("csma"));
    CHECK(hint("routing", "AodvHelper") == meant("aodv"));
    CHECK(hint("move", "RandomWaypointMobilityModel") == meant("random_waypoint"));
    CHECK(hint("move", "GaussMarkovMobility") == meant("gauss_markov"));
    CHECK(hint("move", "ConstantPositionMobilityModel") == meant("fixed"));
}

TEST_CASE("for a model that rovernet lacks, the hint names the page that lists replacements") {
    const std::string there =
        " is not available: \"rovernet help not-there\" lists what to use instead";
    for (const char* protocol : {"OLSR", "DSDV", "Olsr", "TORA"})
        CHECK(hint("routing", protocol) == protocol + there);
    CHECK(hint("propagation", "OkumuraHata") == "OkumuraHata" + there);
    for (const char* access : {"Mac/Tdma", "TdmaMac", "BMac", "LMac", "Mac/SMAC"})
        CHECK(hint("access", access) == access + there);
}

TEST_CASE(
    "no hint is given for a name that is unknown, malformed or belongs to a different table") {
    CHECK(hint("routing", "TwoRayGround").empty());
    CHECK(hint("propagation", "OLSR").empty());
    CHECK(hint("fading", "Shadowing").empty());
    CHECK(hint("propagation", "hovercraft").empty());
    for (const std::string& word : {std::string(), std::string("_"), std::string("\xff\x00", 2),
                                    std::string("Propagation/"), std::string(100'000, 'x')})
        CHECK(hint("propagation", word).empty());
}

TEST_CASE(
    "the error for a name of another simulator in a scenario file ends with a hint on what to use "
    "instead") {
    CHECK(error_of("[propagation]\nmodel = \"TwoRayGround\"\n")
              .ends_with("\"rays\"; " + meant("two_ray")));
    CHECK(error_of("[routing]\nprotocol = \"OLSR\"\n") ==
          "s.toml:3:12: unknown protocol \"OLSR\"; expected one of \"flood\", \"aodv\", \"dsr\", "
          "\"suppression\", \"managed\"; OLSR is not available: \"rovernet help not-there\" lists "
          "what "
          "to use instead");
    CHECK(error_of("[access]\nmodel = \"Mac/802_11\"\n").ends_with(meant("csma")));
}

}  // namespace simulator_names_test
