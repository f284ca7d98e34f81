// SPDX-License-Identifier: MIT
#include "pictures/chart/chart.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <string>
#include <vector>

namespace chart_vega_test {
using namespace rovernet;

namespace {

using Json = nlohmann::json;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

Json specification(const Chart& chart) { return Json::parse(chart_vega_lite(chart)); }

Chart two_series(ChartKind kind) {
    Chart out{.kind = kind, .title = "title", .x_label = "x [m]", .y_label = "y [s]"};
    for (const char* name : {"first", "second"}) {
        ChartSeries series{name};
        for (int i = 0; i < 7; ++i) {
            series.points.push_back(
                {.x = double(i), .y = i * 2.0, .low = i - 1.0, .high = i * 3.0});
        }
        out.series.push_back(series);
    }
    return out;
}

std::vector<std::string> marks(const Json& specification) {
    std::vector<std::string> out;
    for (const auto& layer : specification["layer"]) out.push_back(layer["mark"]["type"]);
    return out;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("vega: a specification holds its version, its texts and all its points") {
    const Json json = specification(two_series(ChartKind::lines));
    CHECK(json["$schema"] == "https://vega.github.io/schema/vega-lite/v5.json");
    CHECK(json["title"]["text"] == "title");
    CHECK(json["encoding"]["x"]["title"] == "x [m]");
    CHECK(json["layer"][0]["encoding"]["y"]["title"] == "y [s]");
    const Json& values = json["data"]["values"];
    REQUIRE(values.size() == 14);
    CHECK(values[8]["series"] == "second");
    CHECK((values[8]["x"] == 1 && values[8]["y"] == 2));
    CHECK((values[8]["low"] == 0 && values[8]["high"] == 3));
    CHECK(json["encoding"]["color"]["scale"]["domain"] == Json({"first", "second"}));
    CHECK(json["encoding"]["color"]["scale"]["range"].size() == 2);
}

TEST_CASE("vega: each kind has its marks") {
    CHECK(marks(specification(two_series(ChartKind::lines))) == Texts{"area", "line", "point"});
    CHECK(marks(specification(two_series(ChartKind::bars))) == Texts{"bar", "rule"});
    CHECK(marks(specification(two_series(ChartKind::scatter))) == Texts{"rule", "point", "text"});
    CHECK(marks(specification(two_series(ChartKind::cdf))) == Texts{"line"});
    CHECK(marks(specification(two_series(ChartKind::heat_map))) == Texts{"rect", "text"});
    Chart few = two_series(ChartKind::lines);
    for (auto& series : few.series) series.points.resize(3);
    CHECK(marks(specification(few)) == Texts{"rule", "line", "point"});
}

TEST_CASE("vega: axes show what the picture's do, logarithmic where asked") {
    Chart log = two_series(ChartKind::scatter);
    log.log_x = true;
    const Json json = specification(log);
    CHECK(json["encoding"]["x"]["scale"]["type"] == "log");
    CHECK(json["encoding"]["x"]["scale"]["domain"][0] > 0);
    CHECK(json["layer"][0]["encoding"]["y"]["scale"]["type"] == "linear");
    CHECK(json["data"]["values"].size() == 12);
}

TEST_CASE("vega: the pieces of a broken line are told apart") {
    Chart lines = two_series(ChartKind::lines);
    lines.series[0].points[3].y = no_number;
    const Json json = specification(lines);
    const Json& values = json["data"]["values"];
    REQUIRE(values.size() == 13);
    CHECK((values[2]["part"] == 1 && values[3]["part"] == 2 && values[6]["part"] == 1));
    CHECK(json["encoding"]["detail"]["field"] == "part");
    CHECK(json["title"]["subtitle"] == Json({"1 value left out: not finite"}));
}

TEST_CASE("vega: steps of a cdf begin at 0, end at 1 and follow the share") {
    Chart cdf{.kind = ChartKind::cdf, .series = {{"s", {{.x = 3}, {.x = 1}}}}};
    const Json values = specification(cdf)["data"]["values"];
    REQUIRE(values.size() == 4);
    CHECK((values[0]["y"] == 0 && values[1]["y"] == 0.5 && values[2]["y"] == 1));
    CHECK((values[1]["x"] == 1 && values[2]["x"] == 3 && values[3]["y"] == 1));
}

TEST_CASE("vega: words keep their order, and rows of a map stand upwards") {
    Chart heat{.kind = ChartKind::heat_map,
               .series = {{"low", {{.category = "b", .y = 1}, {.category = "a", .y = 2}}},
                          {"high", {{.category = "a", .y = 3}}}}};
    const Json json = specification(heat);
    CHECK(json["encoding"]["x"]["sort"] == Json({"b", "a"}));
    CHECK(json["encoding"]["y"]["sort"] == Json({"high", "low"}));
}

TEST_CASE("vega: any text is a JSON string, and an empty chart says so") {
    Chart chart = two_series(ChartKind::scatter);
    chart.title = "\"\\ \x01 \xff </script>";
    chart.series[0].points[0].label = chart.title;
    const Json json = specification(chart);
    CHECK(json["title"]["text"] == "\"\\ \x01 \xef\xbf\xbd </script>");
    for (const ChartKind kind : {ChartKind::lines, ChartKind::bars, ChartKind::heat_map}) {
        CHECK(specification({.kind = kind})["data"]["values"][0]["text"] == "no results");
    }
}

}  // namespace chart_vega_test
