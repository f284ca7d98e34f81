// SPDX-License-Identifier: MIT
// Every number of a file of levels has its range: what is outside is told with its place.
#include "scenario/scenario_file.hpp"
#include "sim/error.hpp"
#include "study/calibration/known_links.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace levels_range_test {
using namespace rovernet;

namespace {

constexpr std::array<const char*, 7> columns{"from_x_m", "from_y_m", "from_z_m", "to_x_m",
                                             "to_y_m",   "to_z_m",   "level_dbm"};

/// What is said of a file in which one column of the third line has this text; empty: nothing.
std::string said(std::size_t column, const std::string& text) {
    const test::TemporaryFolder folder;
    std::vector<std::string> cells{"1", "2", "3", "4", "5", "6", "-70"};
    cells[column] = text;
    const std::string file = folder.write(
        "l.csv",
        fmt::format("{}\n1,2,3,4,5,6,-60\n{}\n", fmt::join(columns, ","), fmt::join(cells, ",")));
    const Scenario scenario =
        load_scenario(folder.write("s.toml",
                                   "[[robot]]\nname = \"A\"\nat = [\"0 m\", \"0 m\"]\n"
                                   "[scenario]\nduration = \"1 s\"\n"),
                      {});
    try {
        read_levels(file, scenario, std::nullopt, Receivers::known);
        return "";
    } catch (const InputError& error) {
        CHECK(error.where().line == 3);
        CHECK(error.where().column == 2 * static_cast<int>(column) + 1);
        return error.message();
    }
}

}  // namespace

TEST_CASE("levels: a number out of range is an error with line, column and range") {
    for (std::size_t column = 0; column < columns.size(); ++column) {
        CAPTURE(columns[column]);
        const bool is_level = column + 1 == columns.size();
        for (const char* bad : {"1e200", "-1e200", "1e300", "1.1e9", "-1.1e9", "1e400", "nan",
                                "-nan", "inf", "-inf", "x", "0x10", "1e", "1 2"}) {
            CAPTURE(bad);
            const std::string range =
                is_level ? "a level from -300 to 100 [dBm]" : "a coordinate from -1e9 to 1e9 [m]";
            CHECK(said(column, bad) == fmt::format("found \"{}\", expected {}", bad, range));
        }
        const std::vector<const char*> good =
            is_level ? std::vector{"-300", "100", "0", "-0.0", "1e-300", "4.9e-324", "+3"}
                     : std::vector{"1e9", "-1e9", "0", "-0.0", "1e-300", "4.9e-324", "+3"};
        for (const char* each : good) {
            CAPTURE(each);
            CHECK(said(column, each) == "");
        }
    }
}

TEST_CASE("levels: a level below -300 dBm or above 100 dBm is an error") {
    for (const char* bad : {"-300.1", "100.1", "-999", "1000"}) {
        CHECK(said(6, bad) ==
              fmt::format("found \"{}\", expected a level from -300 to 100 [dBm]", bad));
    }
}

}  // namespace levels_range_test
