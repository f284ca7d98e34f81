// SPDX-License-Identifier: MIT
#include "experiment/reports/link_table.hpp"

#include "experiment/reports/network_at.hpp"
#include "experiment/run.hpp"
#include "scenario/scenario.hpp"
#include "scenario/scenario_file.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

namespace link_table_test {
using namespace rovernet;

TEST_CASE(
    "links: each robot's link table is passed to the caller before the next table is computed") {
    const test::TemporaryFolder folder;
    const Scenario scenario = load_scenario(folder.write("s.toml", R"([[robot]]
name = "r"
count = 3
place = { area = [["0 m", "0 m"], ["1 m", "1 m"]] }
)"),
                                            {});
    const auto network = network_at(scenario, start_of_run);
    int told = 0;
    struct Enough {};
    const auto stop_at_second = [&](const LinkTable& table) {
        CHECK(table.rows.size() == 2);
        if (++told == 2) throw Enough{};
    };
    CHECK_THROWS_AS(for_each_link_table(*network, {}, stop_at_second), Enough);
    CHECK(told == 2);
}

TEST_CASE("where: the command simulates traffic only if a message can make a robot move") {
    const test::TemporaryFolder folder;
    const std::string text = R"([[robot]]
name = "a"
at = ["0 m", "0 m"]
[[robot]]
name = "b"
at = ["5 m", "0 m"]
)";
    const std::string traffic = "[[traffic]]\nfrom = \"a\"\npayload = \"F\"\nevery = \"1 ms\"\n";
    const Scenario idle = load_scenario(folder.write("i.toml", text + traffic), {});
    CHECK(without_idle_traffic(idle).traffic.empty());
    const Scenario moved = load_scenario(
        folder.write("m.toml",
                     text +
                         "on_receive = { payload = \"F\", move = { model = \"waypoints\", path = "
                         "[[\"9 m\", \"0 m\"]], speed = \"1 m/s\" } }\n" +
                         traffic),
        {});
    CHECK(without_idle_traffic(moved).traffic.size() == 1);
}

}  // namespace link_table_test
