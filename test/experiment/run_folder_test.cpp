// SPDX-License-Identifier: MIT
#include "experiment/run_folder.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

namespace run_folder_test {
using namespace rovernet;

namespace {

std::string folder(const std::vector<std::string>& set) {
    Scenario scenario;
    scenario.scenario.name = "rescue";
    scenario.scenario.seed = 7;
    return run_folder(scenario, set);
}

}  // namespace

TEST_CASE("run folder: the path has the scenario's name, the seed, and the replication if not 0") {
    Scenario scenario;
    scenario.scenario.name = "rescue";
    scenario.scenario.seed = 7;
    CHECK(run_folder(scenario, {}) == "runs/rescue-s7");
    scenario.scenario.replication = 3;
    CHECK(run_folder(scenario, {}) == "runs/rescue-s7-r3");
    CHECK(folder({"scenario.seed=7", "scenario.name=rescue"}) == "runs/rescue-s7");
}

TEST_CASE("run folder: the path lists settings that differ from the scenario file") {
    CHECK(folder({"radio.power=20 dBm"}) == "runs/rescue-s7-radio.power=20dBm");
    CHECK(folder({"routing.ttl=3", "radio.power=\"20 dBm\""}) ==
          "runs/rescue-s7-radio.power=20dBm-routing.ttl=3");
    CHECK(folder({"propagation.sigma=-0.5"}) == "runs/rescue-s7-propagation.sigma=-0.5");
    CHECK(folder({"propagation.model=disc"}) == "runs/rescue-s7-propagation.model=disc");
}

TEST_CASE("run folder: equal settings in different notation give the same folder") {
    CHECK(folder({"a.b=1", "c.d=x"}) == folder({"c.d=\"x\"", "a.b=2", "a.b=1"}));
}

TEST_CASE("run folder: different settings give different folders") {
    const std::vector<std::vector<std::string>> sets = {
        {},
        {"a.b=1"},
        {"a.b=2"},
        {"a.c=1"},
        {"a.b=1", "a.c=1"},
        {"p.payload=a/b"},
        {"p.payload=a_b"},
        {"p.payload=a b"},
        {"p.payload=ab"},
        {"p.payload=../../../etc"},
        {"p.path=[[1, 2], [3, 4]]"},
        {"p.path=[[1, 2], [3, 5]]"},
        {"p.payload=" + std::string(300, 'x')},
        {"p.payload=" + std::string(301, 'x')},
        {"p.payload=\xC3\xA9"},
    };
    std::set<std::string> folders;
    for (const auto& set : sets) {
        const std::string name = folder(set);
        CAPTURE(name);
        CHECK(folders.insert(name).second);
        CHECK(name.size() < 120);
        CHECK(name.find('/', 5) == std::string::npos);
        for (const char c : name) CHECK((c > ' ' && c < 0x7f));
    }
}

}  // namespace run_folder_test
