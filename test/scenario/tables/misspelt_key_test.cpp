// SPDX-License-Identifier: MIT
// A misspelt key of a table is reported before the values of the table, which it may explain.
#include "scenario/document/toml.hpp"
#include "scenario/scenario.hpp"
#include "sim/error.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace misspelt_key_test {
using namespace rovernet;

namespace {

std::string error_of(const std::string& toml) {
    try {
        read_scenario(parse_toml(toml, "s.toml"), "s.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// A table with a value that is wrong, and a misspelt key behind it.
struct Misspelt {
    std::string toml, key, meant;
};

const std::string robot = "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n";

const std::vector<Misspelt> tables = {
    {"[radio]\npower = \"x\"\n[acess]\nmodel = \"csma\"", "acess", "access"},
    {"[scenario]\nduration = \"-1 s\"\nsed = 1", "sed", "seed"},
    {"[scene]\nsize = [\"1 m\"]\nmpa = \"a.png\"", "mpa", "map"},
    {"[scene.materials.wood]\ngrey = 1000\nthicknes = \"1 m\"", "thicknes", "thickness"},
    {"[[scene.floor]]\nmap = 1\nheigth = \"1 m\"", "heigth", "height"},
    {"[[scene.floor]]\nceiling = { per_crossing = 1e9, thicknes = \"1 m\" }", "thicknes",
     "thickness"},
    {"[[scene.door]]\nfrom = 1\nclosse = [\"1 s\"]", "closse", "closes"},
    {"[access]\nmodel = \"csma\"\nqueue = 0\nstandrad = \"802.11a\"", "standrad", "standard"},
    {"[access]\nmodl = \"csma\"\nqueue = 0", "modl", "model"},
    {"[radio]\npower = \"x\"\nsensitivty = \"-80 dBm\"", "sensitivty", "sensitivity"},
    {"[medium]\npropagation_delay = 1\npropagation_dela = true", "propagation_dela",
     "propagation_delay"},
    {"[propagation]\nrange = \"-1 m\"\nmodle = \"disc\"", "modle", "model"},
    {"[routing]\nprotocl = \"aodv\"\nhello = \"-1 s\"", "protocl", "protocol"},
    {"[study]\nreplications = 0\nconfidense = 0.9", "confidense", "confidence"},
    {"[study]\nvary.a = { from = \"x\", to = 2, step = 1, stp = 2 }", "stp", "step"},
    {"[metrics]\nreach = 1\ntopolgy = true", "topolgy", "topology"},
    {"[[traffic]]\nfrom = \"A\"\nknd = \"unicast\"\nto = \"B\"\npayload = \"x\"", "knd", "kind"},
    {"[[traffic]]\nfrom = \"A\"\npayload = \"x\"\nstop = \"1 s\"\nevry = \"1 s\"", "evry", "every"},
    {"[[robot]]\nname = \"B\"\nradius = \"-1 m\"\nheding = \"0 deg\"", "heding", "heading"},
    {"[[robot]]\nname = \"B\"\nplace = { points = 1, modl = \"choice\" }", "modl", "model"},
    {"[[robot]]\nname = \"B\"\nmove = { model = \"patrol\", path = 1, sped = \"1 m/s\" }", "sped",
     "speed"},
    {"[[robot]]\nname = \"B\"\nscan = { beams = 0, rnge = \"1 m\" }", "rnge", "range"},
    {"[[robot]]\nname = \"B\"\nat = [\"1 m\", \"0 m\"]\non_receive = { size = \"-1 B\", sned = "
     "\"x\" }",
     "sned", "send"},
};

}  // namespace

TEST_CASE("tables: a misspelt key is reported before a wrong value in the same table") {
    for (const Misspelt& each : tables) {
        CAPTURE(each.toml);
        const std::string error = error_of(robot + each.toml + "\n");
        CAPTURE(error);
        CHECK(error.find("unknown key \"" + each.key + "\" in ") != std::string::npos);
        CHECK(error.find("did you mean \"" + each.meant + "\"?") != std::string::npos);
    }
}

}  // namespace misspelt_key_test
