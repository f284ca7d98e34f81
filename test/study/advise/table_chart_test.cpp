// SPDX-License-Identifier: MIT
#include "study/advise/table_chart.hpp"

#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

namespace table_chart_test {
using namespace rovernet;
using test::TemporaryFolder;

namespace {

const char* const table =
    "# measured elsewhere\n"
    "program,robots,cost,cost low,cost high\n"
    "ours,10,1,0.5,1.5\n"
    "ours,100,2,,\n"
    "theirs,10,30,29,31\n"
    "theirs,100,,,\n";

Chart draw(const std::string& text, const ChartQuestion& question) {
    const TemporaryFolder folder;
    return table_chart(folder.write("costs.csv", text), question);
}

}  // namespace

TEST_CASE(
    "table chart: each value of the `by` column is a series, other columns give intervals, and "
    "rows without y are left out") {
    const Chart chart = draw(table, {.x = "robots", .y = "cost", .by = "program", .log_x = true});
    CHECK(chart.kind == ChartKind::lines);
    CHECK(chart.x_label == "robots");
    CHECK(chart.note == "costs.csv");
    CHECK(chart.log_x);
    REQUIRE(chart.series.size() == 2);
    CHECK(chart.series[0].name == "ours");
    REQUIRE(chart.series[0].points.size() == 2);
    CHECK(chart.series[0].points[0].low == 0.5);
    CHECK(chart.series[0].points[0].high == 1.5);
    CHECK(chart.series[0].points[1].x == 100);
    CHECK_FALSE(chart.series[0].points[1].low);
    CHECK(chart.series[1].points.size() == 1);
}

TEST_CASE("table chart: x values may have units or be words, and conditions select rows") {
    const Chart lines = draw("d,y\n1 m,1\n200 cm,2\n", {.x = "d", .y = "y"});
    CHECK(lines.x_label == "d [m]");
    CHECK(lines.series[0].points[1].x == 2);
    const Chart bars = draw(table, {.x = "program", .y = "cost", .where = {{"robots", "10"}}});
    CHECK(bars.kind == ChartKind::bars);
    REQUIRE(bars.series.size() == 1);
    REQUIRE(bars.series[0].points.size() == 2);
    CHECK(bars.series[0].points[1].category == "theirs");
}

TEST_CASE("table chart: a table or a request that cannot be drawn is refused") {
    CHECK_THROWS_WITH_AS(draw(table, {.x = "robots", .y = "price"}),
                         doctest::Contains("costs.csv:2:1: no column \"price\""), InputError);
    CHECK_THROWS_WITH_AS(draw("a,b\n1,x\n", {.x = "a", .y = "b"}),
                         doctest::Contains("costs.csv:2:3: b: found \"x\""), InputError);
    CHECK_THROWS_WITH_AS(draw(table, {.y = "cost"}), doctest::Contains("-x"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(draw(table, {.kind = ChartKind::cdf, .x = "robots", .y = "cost"}),
                         doctest::Contains("--kind lines or --kind bars"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(draw(table, {.kind = ChartKind::lines, .x = "program", .y = "cost"}),
                         doctest::Contains("words"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(draw(table, {.x = "robots", .y = "cost", .where = {{"program", "none"}}}),
                         doctest::Contains("no row"), std::invalid_argument);
}

}  // namespace table_chart_test
