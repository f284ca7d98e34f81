// SPDX-License-Identifier: MIT
#include "pictures/chart/chart.hpp"
#include "test/pictures/chart/drawn_chart.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace chart_gnuplot_test {
using namespace rovernet;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

bool has(const std::string& text, std::string_view word) { return text.find(word) != text.npos; }

Chart three_points(ChartKind kind, const std::string& text) {
    Chart out{.kind = kind, .title = text, .x_label = text, .y_label = text, .note = text};
    out.series.push_back({text, {}});
    for (int i = 1; i <= 3; ++i) {
        out.series[0].points.push_back({.x = double(i),
                                        .y = i + 0.5,
                                        .low = i + 0.25,
                                        .high = i + 1.0,
                                        .label = text,
                                        .n = 9});
    }
    out.series.push_back({"other " + text, {{.category = text, .y = 0.125}}});
    return out;
}

bool gnuplot_is_there() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

/// What gnuplot draws of a script, and what it says.
struct Drawn {
    int status;
    std::string svg, errors;
    bool ran_a_command;
};

Drawn drawn(const std::string& script) {
    const test::TemporaryFolder folder;
    const auto content = [](const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string path = folder.write("chart.gp", script);
    const int status = std::system(fmt::format("cd '{0}' && gnuplot chart.gp >chart.svg 2>errors",
                                               std::filesystem::path(path).parent_path().string())
                                       .c_str());
    return {status, content(folder.path("chart.svg")), content(folder.path("errors")),
            std::filesystem::exists(folder.path("pwned"))};
}

}  // namespace

TEST_CASE("gnuplot: a script contains the values and the error bars of each series") {
    Chart chart = three_points(ChartKind::scatter, "t");
    chart.series.pop_back();
    const std::string text = chart_gnuplot(chart);
    CHECK(has(text, "$series0 << EOD\n# x y low high n\n1 1.5 1.25 2 9\n2 2.5 2.25 3 9\n"));
    CHECK(has(text, "EOD\n"));
    CHECK(has(text, "set title 't'"));
}

TEST_CASE("gnuplot: a missing value breaks the line, and a missing error bar is written as NaN") {
    Chart chart{.series = {{"s", {{.x = 1, .y = 1}, {.x = 2, .y = no_number}, {.x = 3, .y = 3}}}}};
    CHECK(has(chart_gnuplot(chart), "1 1 NaN NaN 0\n\n3 3 NaN NaN 0\n"));
}

TEST_CASE(
    "gnuplot: a cdf is drawn with steps, a heat map with cells, and bars are drawn side by side") {
    const Chart cdf{.kind = ChartKind::cdf, .series = {{"s", {{.x = 4}, {.x = 2}}}}};
    CHECK(has(chart_gnuplot(cdf), "# x share\n2 0\n2 0.5\n4 1\n4 1\n"));
    Chart two{.kind = ChartKind::heat_map,
              .series = {{"a", {{.x = 7, .y = 1}}}, {"b", {{.x = 8, .y = 2, .n = 3}}}}};
    CHECK(has(chart_gnuplot(two), "# column row value n\n0 0 1 0\n1 1 2 3\n"));
    two.kind = ChartKind::bars;
    CHECK(has(chart_gnuplot(two), "-0.2 1 NaN NaN 0\n"));
    CHECK(has(chart_gnuplot(two), "1.2 2 NaN NaN 3\n"));
    CHECK(has(chart_gnuplot(two), "set boxwidth 0.4"));
}

TEST_CASE("gnuplot: a whisker that would reach below a logarithmic axis ends at the axis") {
    Chart chart{.kind = ChartKind::scatter,
                .series = {{"s", {{.x = 1, .y = 2, .low = -5, .high = 9}}}}};
    chart.log_y = true;
    CHECK(has(chart_gnuplot(chart), "1 2 2 9 0\n"));
}

TEST_CASE("gnuplot: texts are in single quotes, on one line") {
    const std::string text = chart_gnuplot(three_points(ChartKind::bars, "it's\n`x` \"y\" 5%"));
    CHECK(has(text, "set title 'it\xe2\x80\x99s `x` \"y\" 5%'"));
    CHECK(has(text, "'it\xe2\x80\x99s `x` \"y\" 5%%' 3"));
}

TEST_CASE(
    "gnuplot: every kind of chart is drawn without a warning, and no text is executed as a "
    "command") {
    if (!gnuplot_is_there()) {
        MESSAGE("skipped: gnuplot is not installed");
        return;
    }
    for (const ChartKind kind : test::chart_kinds) {
        for (const char* text :
             {"plain", "", "'`touch pwned`' `touch pwned` $(touch pwned) @x \\\n'; !touch pwned",
              "%d %s <b>&\n#\nEOD\n{/Symbol a}_x"}) {
            CAPTURE(std::string(text));
            const Drawn result = drawn(chart_gnuplot(three_points(kind, text)));
            CHECK(result.status == 0);
            CHECK(result.errors == "");
            CHECK(has(result.svg, "<svg"));
            CHECK(has(result.svg, "</svg>"));
            CHECK_FALSE(result.ran_a_command);
        }
        CHECK(has(drawn(chart_gnuplot({.kind = kind})).svg, "no results"));
    }
}

}  // namespace chart_gnuplot_test
