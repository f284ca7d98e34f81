// SPDX-License-Identifier: MIT
#include "pictures/map/picture.hpp"

#include "experiment/build.hpp"
#include "mobility/waypoints.hpp"
#include "pictures/draw/picture_file.hpp"
#include "pictures/map/coverage.hpp"
#include "pictures/map/map_layer.hpp"
#include "pictures/map/trail.hpp"
#include "scenario/document/toml.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/images/image.hpp"
#include "sim/error.hpp"
#include "test/pictures/draw/well_formed.hpp"
#include "test/scene/drawn_map.hpp"
#include "test/scene/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <zlib.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace picture_test {
using namespace rovernet;

namespace {

using namespace std::chrono_literals;

Scenario scenario(const std::string& text, const std::string& file = "p.toml") {
    return read_scenario(parse_toml(text, file), file);
}

Scenario rescue() { return load_scenario(ROVERNET_EXAMPLES "/rescue/rescue.toml", {}); }

std::string robot(const std::string& name, double x, double y, const std::string& more = "") {
    return fmt::format("[[robot]]\nname = \"{}\"\nat = [\"{} m\", \"{} m\"]\n{}", name, x, y, more);
}

std::size_t count(std::string_view text, std::string_view word) {
    std::size_t n = 0;
    for (auto i = text.find(word); i != text.npos; i = text.find(word, i + word.size())) ++n;
    return n;
}

bool has(std::string_view text, std::string_view word) { return count(text, word) > 0; }

/// The objects of a PDF, those that newer writers compress (zlib) behind the others.
std::string unpacked(const std::string& pdf) {
    constexpr std::string_view begin = "stream\n";
    std::string all = pdf;
    for (auto at = pdf.find(begin); at != pdf.npos; at = pdf.find(begin, at + 1)) {
        const std::string packed = pdf.substr(at + begin.size());
        std::string text(1 << 16, '\0');
        uLongf size = text.size();
        const int result = uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                                      reinterpret_cast<const Bytef*>(packed.data()), packed.size());
        if (result == Z_OK) all.append(text, 0, size);
    }
    return all;
}

/// The number behind the first `key="` in the text.
double number(std::string_view text, std::string_view key) {
    const auto at = text.find(std::string(key) + "=\"");
    REQUIRE(at != text.npos);
    const char* begin = text.data() + at + key.size() + 2;
    double v = 0;
    std::from_chars(begin, text.data() + text.size(), v);
    return v;
}

/// What follows the start of the robot's circle.
std::string_view circle_of(std::string_view svg, std::string_view name) {
    svg.remove_prefix(svg.find(fmt::format("<title>{}</title>", name)));
    svg.remove_prefix(svg.find("<circle "));
    return svg;
}

constexpr double rounding = 0.021;  // [px] of differences and sums of numbers with two decimals

const PictureOptions everything{
    .at = start_of_run + 12s, .coverage = {"A"}, .links = true, .trails = true, .cells = 2000};

/// The picture that is embedded in the document.
Image embedded_image(std::string_view svg) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::string_view key = "data:image/png;base64,";
    const auto begin = svg.find(key) + key.size();
    const auto data = svg.substr(begin, svg.find('"', begin) - begin);
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : data.substr(0, data.find('='))) {
        bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU);
    }
    test::TemporaryFolder folder;
    return read_image(folder.write("embedded.png", bytes));
}

/// Removes rsvg-convert from sight while it lives.
struct EmptyPath {
    EmptyPath() : old(std::getenv("PATH") ? std::getenv("PATH") : "") { set("/nonexistent"); }
    ~EmptyPath() { set(old.c_str()); }
    EmptyPath(const EmptyPath&) = delete;
    EmptyPath& operator=(const EmptyPath&) = delete;
    static void set(const char* path) { setenv("PATH", path, 1); }
    std::string old;
};

}  // namespace

TEST_CASE(
    "picture: the picture of the example `rescue` is well-formed, and has equal bytes when drawn "
    "twice") {
    const std::string svg = draw_svg(rescue(), everything);
    CHECK(test::xml_fault(svg) == "");
    CHECK(svg == draw_svg(rescue(), everything));
}

TEST_CASE("picture: the caption names the scenario, the time and the model with its parameters") {
    const std::string svg = draw_svg(rescue(), {.at = start_of_run + 1500ms});
    CHECK(has(svg, ">rescue</text>"));
    CHECK(has(svg, "t = 1.5 s"));
    CHECK(has(svg, "raytrace_2007: coefficient 20, wall_factor 0.3"));
}

TEST_CASE("picture: the caption names each propagation model in use exactly once") {
    const std::string disc = "propagation = { model = \"disc\", range = \"5 m\" }\n";
    const std::string all = draw_svg(scenario(robot("a", 0, 0, disc) + robot("b", 9, 0, disc)),
                                     {.coverage = {"a"}, .cells = 9});
    CHECK(count(all, "disc: range 5 m") == 1);
    CHECK_FALSE(has(all, "friis"));
    const std::string mixed = draw_svg(scenario(robot("a", 0, 0, disc) + robot("b", 9, 0)),
                                       {.coverage = {"a"}, .cells = 9});
    CHECK(has(mixed, "disc: range 5 m \xc2\xb7 friis"));
    CHECK(has(mixed, "has the model disc"));
}

TEST_CASE("picture: names are escaped, in labels and in the title") {
    const std::string svg = draw_svg(
        scenario("[scenario]\nname = \"<&>\"\n" + robot("a<b>&'", 0, 0) + robot("c", 3, 0)), {});
    CHECK(test::xml_fault(svg) == "");
    CHECK(has(svg, ">a&lt;b&gt;&amp;&#39;</text>"));
    CHECK(has(svg, ">&lt;&amp;&gt;</text>"));
}

TEST_CASE("picture: every robot has a circle inside the frame, even a robot off the map") {
    const std::string svg =
        draw_svg(scenario("[scene]\nmap = \"map.yaml\"\n" + robot("in", 24, 12) +
                              robot("west", -30, 5) + robot("north", 10, 60),
                          ROVERNET_EXAMPLES "/rescue/x.toml"),
                 {});
    CHECK(count(svg, "<circle ") == 3);
    const double width = number(svg, "width"), height = number(svg, "height");
    std::string_view rest = svg;
    for (int i = 0; i < 3; ++i) {
        rest.remove_prefix(rest.find("<circle "));
        CHECK(number(rest, "cx") > 0);
        CHECK(number(rest, "cx") < width);
        CHECK(number(rest, "cy") > 0);
        CHECK(number(rest, "cy") < height);
        CHECK(number(rest, "r") >= 5);
        rest.remove_prefix(1);
    }
}

TEST_CASE("picture: a robot is drawn to scale if it is large enough") {
    const std::string svg =
        draw_svg(scenario(robot("big", 0, 0, "radius = \"2 m\"\n") + robot("b", 20, 0)), {});
    // 22.2 m from rim to rim, and 3 % of that on each side.
    const double scale = number(circle_of(svg, "big"), "r") / 2;
    CHECK(std::abs(scale - (1200 - 32) / (22.2 * 1.06)) < rounding);
    CHECK(number(circle_of(svg, "b"), "r") > 5);
    CHECK(std::abs(number(circle_of(svg, "b"), "r") - 0.2 * scale) < rounding);
}

TEST_CASE("picture: a short line at a robot shows its direction, and north is up") {
    const auto walker = [](const char* to) {
        return robot("n", 0, 0,
                     fmt::format("move = {{ model = \"waypoints\", path = [[{}]] }}\n", to));
    };
    for (const auto& [to, east, north] :
         {std::tuple("\"0 m\", \"20 m\"", 0, 1), std::tuple("\"20 m\", \"0 m\"", 1, 0)}) {
        const std::string svg =
            draw_svg(scenario(walker(to) + robot("b", 20, 0)), {.at = start_of_run + 5s});
        const auto circle = circle_of(svg, "n");
        const double length = number(circle, "r") + 5;
        std::string_view tick = svg;
        tick.remove_prefix(svg.find("<title>n</title>"));
        tick.remove_prefix(tick.find('L') + 1);
        double x = 0, y = 0;
        const auto end = std::from_chars(tick.data(), tick.data() + 20, x).ptr;
        std::from_chars(end + 1, end + 20, y);
        CHECK(std::abs(x - number(circle, "cx") - east * length) < rounding);
        CHECK(std::abs(y - number(circle, "cy") + north * length) < rounding);
    }
}

TEST_CASE("picture: two-way links are solid, one-way links dashed with an arrow at the receiver") {
    const std::string both = robot("a", 0, 0) + robot("b", 50, 0);
    const std::string svg = draw_svg(scenario(both), {.links = true});
    CHECK(has(svg, "link margin"));
    CHECK_FALSE(has(svg, "one way only"));
    CHECK_FALSE(has(svg, "stroke-dasharray=\"7 4\""));

    const std::string deaf = robot("a", 0, 0, "radio = { sensitivity = \"-20 dBm\" }\n");
    const std::string one_way = draw_svg(scenario(deaf + robot("b", 50, 0)), {.links = true});
    CHECK(has(one_way, "one way only"));
    CHECK(has(one_way, "stroke-dasharray=\"7 4\""));
    const auto b = circle_of(one_way, "b");
    // The tip, 2 px before b's circle.
    CHECK(has(one_way, fmt::format("d=\"M{} ", svg_number(number(b, "cx") - number(b, "r") - 2))));

    const std::string none = draw_svg(scenario(deaf + robot("b", 50, 0, "off = [\"1 s\"]\n")),
                                      {.at = start_of_run + 2s, .links = true});
    CHECK_FALSE(has(none, "link margin"));
    CHECK(has(none, "switched off"));
}

TEST_CASE("picture: coverage has a heat map, a colour bar, and a contour for each level") {
    const auto text = robot("A", 0, 0, "radio = { range_db = \"-60 dBm\" }\n") + robot("B", 90, 9);
    const std::string svg = draw_svg(scenario(text), {.coverage = {"A"}, .cells = 500});
    CHECK(has(svg, "data:image/png;base64,"));
    CHECK(has(svg, ">dBm</text>"));
    CHECK(has(svg, "-75 dBm, sensitivity"));
    CHECK(has(svg, "-60 dBm, range_db"));
    CHECK(has(svg, "stroke-dasharray=\"7 4\""));
    const std::string other = draw_svg(scenario(text), {.coverage = {"B"}, .cells = 500});
    CHECK_FALSE(has(other, "range_db"));
    CHECK_FALSE(has(other, "stroke-dasharray=\"7 4\""));
}

TEST_CASE(
    "picture: the coverage of several robots shows at each point the level of the strongest "
    "robot") {
    const auto text = robot("A", 0, 0) + robot("B", 90, 9, "radio = { power = \"20 dBm\" }\n") +
                      robot("C", 45, 0, "radio = { sensitivity = \"-90 dBm\" }\n");
    PictureOptions options{.coverage = {"A", "B"}, .cells = 500};
    const std::string svg = draw_svg(scenario(text), options);
    CHECK(has(svg, "coverage of A or B, whichever is stronger: level for a radio like that of A"));
    CHECK(has(svg, "16.53 dBm at 2450 MHz or 20 dBm at 2450 MHz"));
    CHECK(has(svg, "-75 dBm, sensitivity"));
    options.receiver = "C";
    const std::string for_c = draw_svg(scenario(text), options);
    CHECK(has(for_c, "level for the radio of C"));
    CHECK(has(for_c, "-90 dBm, sensitivity"));
    options.coverage = {"A", "A"};
    CHECK_THROWS_WITH_AS(draw_svg(scenario(text), options), doctest::Contains("\"A\" twice"),
                         InputError);
}

TEST_CASE(
    "picture: for the coverage of several robots, all of them or none must have the model `disc`") {
    const auto disc = [](int range) {
        return fmt::format("propagation = {{ model = \"disc\", range = \"{} m\" }}\n", range);
    };
    const auto text = robot("A", 0, 0, disc(20)) + robot("B", 90, 9, disc(30)) + robot("C", 45, 0);
    CHECK(has(draw_svg(scenario(text), {.coverage = {"A", "B"}, .cells = 500}),
              "range of 20 m or 30 m"));
    CHECK_THROWS_WITH_AS(draw_svg(scenario(text), {.coverage = {"A", "C"}, .cells = 500}),
                         doctest::Contains("the model disc computes no received levels"),
                         std::invalid_argument);
}

TEST_CASE("picture: the heat map is lightest at the position of the robot, and not upside down") {
    // Heard a few metres away only, so that B is in the upper right corner.
    const std::string svg =
        draw_svg(scenario("[radio]\npower = \"-30 dBm\"\n" + robot("A", 0, 0) + robot("B", 40, 30)),
                 {.coverage = {"B"}, .cells = 3000});
    const Image image = embedded_image(svg);
    int best_column = 0, best_row = 0, best = 0;
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            if (image.rgb_sum(column, row) <= best) continue;
            best = image.rgb_sum(column, row);
            best_column = column;
            best_row = row;
        }
    }
    std::string_view frame = svg;
    frame.remove_prefix(svg.find("<image "));
    const double cell_x = number(frame, "width") / image.width;
    const double cell_y = number(frame, "height") / image.height;
    const auto b = circle_of(svg, "B");
    CHECK(std::abs(number(frame, "x") + (best_column + 0.5) * cell_x - number(b, "cx")) < cell_x);
    CHECK(std::abs(number(frame, "y") + (best_row + 0.5) * cell_y - number(b, "cy")) < cell_y);
}

TEST_CASE("picture: with shadowing, the coverage is labelled as the median") {
    const auto text = [](const char* sigma) {
        return fmt::format("[propagation]\nmodel = \"log_distance\"\nsigma = \"{}\"\n", sigma) +
               robot("A", 0, 0);
    };
    const PictureOptions options{.coverage = {"A"}, .cells = 100};
    CHECK(has(draw_svg(scenario(text("5 dB")), options), "median"));
    CHECK_FALSE(has(draw_svg(scenario(text("0 dB")), options), "median"));
}

TEST_CASE(
    "picture: beside the model, the caption names shadowing and its sigma, unless sigma is 0") {
    const auto svg = [](const char* model, const char* sigma) {
        return draw_svg(scenario(fmt::format("[propagation]\nmodel = \"friis\"\n[shadowing]\n"
                                             "model = \"{}\"\nsigma = \"{}\"\n",
                                             model, sigma) +
                                 robot("A", 0, 0)),
                        {});
    };
    CHECK(has(svg("link", "3 dB"), "friis, with shadowing: model link, sigma 3 dB"));
    CHECK(has(svg("field", "3 dB"), "friis, with shadowing: model field, sigma 3 dB"));
    for (const char* model : {"link", "field", "none"}) {
        CHECK(has(svg(model, "0 dB"), "friis"));
        CHECK_FALSE(has(svg(model, "0 dB"), "shadow"));
    }
}

TEST_CASE("picture: a trail has the corners of the robot's path, and marks at equal time steps") {
    Network network;
    const auto trails = std::make_shared<Trails>();
    network.add_sink(trails);
    Robot walker{.name = "w", .at = {0, 0}};
    walker.move = Waypoints{.path = {{10, 0}, {10, 5}}, .speed = {1}};
    const NodeId node = network.add(std::move(walker));
    network.run_until(start_of_run + 30s);
    using Ways = std::vector<std::vector<Vec3>>;
    CHECK(trails->ways(node, start_of_run + 30s) == Ways{{{0, 0}, {10, 0}, {10, 5}}});
    CHECK(trails->ways(node, start_of_run + 12s) == Ways{{{0, 0}, {10, 0}, {10, 2}}});
    CHECK(trails->marks(node, start_of_run + 30s, 8s) ==
          std::vector<Vec3>{{0, 0}, {8, 0}, {10, 5}, {10, 5}});
    CHECK(trails->ways(NodeId{7}, start_of_run).empty());
    network.at(start_of_run + 31s, [&] { network.place(node, {90, 5}); });  // no way leads there
    network.run_until(start_of_run + 40s);
    CHECK(trails->ways(node, start_of_run + 40s) == Ways{{{0, 0}, {10, 0}, {10, 5}}, {{90, 5}}});
}

TEST_CASE("picture: trails are drawn on request") {
    CHECK(has(draw_svg(rescue(), {.at = start_of_run + 30s, .trails = true}),
              "colour, a dot every 10 s"));
    CHECK_FALSE(has(draw_svg(rescue(), {.at = start_of_run + 30s}), "trail"));
}

TEST_CASE(
    "picture: walls of different materials have different patterns, explained in the legend") {
    OccupancyGrid grid = test::drawn_map({"##..", "..##"});
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        grid.cell_materials.push_back(static_cast<std::uint8_t>(i / 4));
    }
    const Scene two(grid, {Material{.name = "brick & co"}, Material{.name = "glass"}});
    const Scene one(test::drawn_map({"##..", "..##"}));
    Extent extent;
    extent.include(two.lower_left());
    extent.include(two.upper_right());
    const Plot plot(extent, {}, {.width = 400, .height = 400});
    const auto drawn = [&](const Scene& scene) {
        const MapLayer layer(scene);
        Svg svg(500, 500);
        Legend legend;
        layer.draw(svg, plot, false);
        layer.append_to(legend, false);
        legend.draw(svg, {0, 420}, 400);
        return svg.finish();
    };
    const std::string svg = drawn(two);
    CHECK(test::xml_fault(svg) == "");
    CHECK(has(svg, "brick &amp; co"));
    CHECK(has(svg, ">glass<"));
    CHECK(has(svg, "id=\"walls1\""));
    CHECK_FALSE(has(drawn(one), "wall<"));
    CHECK_FALSE(has(drawn(one), "walls1"));
}

TEST_CASE("picture: all walls are drawn as one SVG path, and unknown cells in light grey") {
    test::TemporaryFolder folder;
    folder.write("m.pgm", "P2 4 2 255\n0 0 150 150\n255 255 255 255\n");
    folder.write("m.yaml", "image: m.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
    const std::string svg = draw_svg(
        scenario("[scene]\nmap = \"m.yaml\"\n" + robot("a", 1.5, 0.5), folder.path("s.toml")), {});
    CHECK(count(svg, "id=\"walls") == 1);
    CHECK(has(svg, ">unknown</text>"));
    CHECK(has(svg, "fill=\"#e2e2e2\""));
}

TEST_CASE("picture: wall rectangles smaller than half a pixel are merged") {
    test::Draw draw(3);
    OccupancyGrid grid = test::random_map(draw, 1500, 1500, 30);
    grid.cell_width = grid.cell_height = 0.01;
    const Scene scene(grid);
    Extent extent;
    extent.include(scene.lower_left());
    extent.include(scene.upper_right());
    const Plot plot(extent, {}, {.width = 150, .height = 150});
    Svg svg(150, 150);
    MapLayer(scene).draw(svg, plot, false);
    const std::string text = svg.finish();
    CHECK(count(text, "Z") > 100);
    CHECK(count(text, "Z") <= 120'000);  // 300 x 300 tiles of half a pixel, and the long walls
}

TEST_CASE(
    "picture: a picture has the requested width, or less for a tall world, and a limited height") {
    const auto size = [](double dx, double dy) {
        const std::string svg = draw_svg(scenario(robot("a", 0, 0) + robot("b", dx, dy)), {});
        return std::pair(number(svg, "width"), number(svg, "height"));
    };
    CHECK(size(100, 1).first == 1200);
    CHECK(size(100, 1).second < 400);
    CHECK(size(1, 100).first < 600);
    CHECK(size(1, 100).second < 1100);
    CHECK(size(50, 50).second < 1100);
    CHECK(size(0, 0).first <= 1200);
}

TEST_CASE(
    "picture: of a building with storeys, one storey is drawn, with its walls, robots and links") {
    Scenario s = scenario(robot("low", 1.5, 0.5) + robot("stays", 2.5, 0.5) +
                          "[[robot]]\nname = \"high\"\nat = [\"1.5 m\", \"0.5 m\", \"3 m\"]\n"
                          "move = { model = \"goal\", to = [\"4.5 m\", \"0.5 m\", \"3 m\"] }\n" +
                          robot("climbs", 0.5, 1.5,
                                "move = { model = \"goal\", to = [\"4.5 m\", \"1.5 m\", "
                                "\"3 m\"], speed = \"100 m/s\" }\n"));
    OccupancyGrid upper = test::drawn_map({"######", "......", "......"});
    upper.origin.z = 3;
    s.walls = std::make_shared<const Scene>(
        std::vector{test::drawn_map({"......", "......", "......"}), upper},
        std::vector{Material{}});
    const PictureOptions options{.at = start_of_run + 2s, .links = true, .trails = true};
    const auto of_storey = [&](int storey) {
        PictureOptions one = options;
        one.storey = storey;
        return draw_svg(s, one);
    };
    const std::string below = of_storey(1), above = of_storey(2);
    const auto has_robot = [](const std::string& svg, const char* name) {
        return has(svg, fmt::format("<title>{}</title>", name));
    };
    CHECK(has(below, "storey 1 of 2, floor at 0 m"));
    CHECK(has(above, "storey 2 of 2, floor at 3 m"));
    CHECK(has_robot(below, "low"));
    CHECK_FALSE(has_robot(below, "high"));
    CHECK(has_robot(above, "high"));
    CHECK_FALSE(has_robot(above, "low"));
    CHECK(has_robot(below, "climbs"));  // its trail: the stairs are on both
    CHECK(has_robot(above, "climbs"));
    CHECK(count(below, "class=\"trail\"") == 1);
    CHECK(count(above, "class=\"trail\"") == 2);
    CHECK(has(below, "4 links to other storeys"));
    CHECK(has(above, "4 links to other storeys"));
    CHECK_FALSE(has(below, "id=\"walls0\""));
    CHECK(has(above, "id=\"walls0\""));
    CHECK(test::xml_fault(above) == "");
    for (const int storey : {0, 3})
        CHECK_THROWS_WITH_AS(of_storey(storey), doctest::Contains("storey must be from 1 to 2"),
                             std::invalid_argument);
    CHECK_THROWS_WITH_AS(draw_svg(scenario(robot("A", 0, 0)), {.storey = 2}),
                         doctest::Contains("one storey"), std::invalid_argument);
}

TEST_CASE("picture: the coverage on another storey includes the loss of the ceiling") {
    Scenario s =
        scenario(robot("A", 1.5, 0.5) +
                 "[propagation]\nmodel = \"multi_wall\"\n[radio]\nantenna_height = \"1 m\"\n");
    OccupancyGrid upper = test::drawn_map({"......", "......"});
    upper.origin.z = 3;
    s.walls = std::make_shared<const Scene>(
        std::vector{test::drawn_map({"......", "......"}), upper}, std::vector{Material{}},
        std::vector{Material{.per_crossing = 12_dB}});
    Network network(network_settings(s));
    populate(network, s);
    Transmitter t = transmitter(network, {0}, start_of_run);
    t.receivers_above = 3;
    const CoverageMap map = coverage(t, {0, 0}, {6, 2}, 48);
    const Vec3 p = map.centre(7, 1);
    CHECK(p.z == 4);
    double expected = 0;
    received_levels(t, {&p, 1}, {&expected, 1});
    CHECK(map.at(7, 1) == expected);
    t.receivers_above = 0;
    const Vec3 q{p.x, p.y, 1};
    double below = 0;
    received_levels(t, {&q, 1}, {&below, 1});
    const double spread =
        20 * std::log10(distance(p, t.antenna) / std::max(distance(q, t.antenna), 1.0));
    CHECK(below - expected == doctest::Approx(12 + spread));
}

TEST_CASE(
    "picture: the coverage for the radio of another robot uses that robot's antenna height and "
    "gain") {
    const std::string access_point =
        "[propagation]\nmodel = \"friis\"\n[[robot]]\nname = \"AP\"\nat = [\"0 m\", \"0 m\"]\n"
        "radio = { antenna_height = \"5 m\" }\n";
    const auto rover = [](const char* radio) {
        return std::string("[[robot]]\nname = \"rover\"\nat = [\"20 m\", \"0 m\"]\nradio = { ") +
               radio + " }\n";
    };
    const auto drawn = [&](const char* radio, std::optional<std::string> receiver) {
        return draw_svg(scenario(access_point + rover(radio)),
                        {.coverage = {"AP"}, .receiver = std::move(receiver), .cells = 400});
    };
    const char* low = "antenna_height = \"1 m\"";
    CHECK(drawn(low, "rover").find("for the radio of rover, antenna 1 m up") != std::string::npos);
    CHECK(drawn(low, {}).find("for a radio like its own, antenna 5 m up") != std::string::npos);
    // The link that the network has there is what the picture shows.
    Network network(network_settings(scenario(access_point + rover("antenna_gain = \"7 dB\""))));
    populate(network, scenario(access_point + rover("antenna_gain = \"7 dB\"")));
    Transmitter t = transmitter(network, {0}, start_of_run);
    const Transmitter rover_itself = transmitter(network, {1}, start_of_run);
    const Vec3 there = rover_itself.antenna;
    double like_its_own = 0, for_rover = 0;
    received_levels(t, {&there, 1}, {&like_its_own, 1});
    t.receiver = rover_itself.radio;
    received_levels(t, {&there, 1}, {&for_rover, 1});
    CHECK(for_rover == doctest::Approx(like_its_own + 7));
    CHECK_THROWS_WITH_AS(drawn(low, "rovr"), doctest::Contains("\"rover\""), std::invalid_argument);
}

TEST_CASE("picture: an unknown robot, or an option out of range, is refused") {
    const Scenario s = scenario(robot("alpha", 0, 0) + robot("beta", 5, 0));
    CHECK_THROWS_WITH_AS(draw_svg(s, {.coverage = {"alpa"}}), doctest::Contains("\"alpha\""),
                         std::invalid_argument);
    CHECK_THROWS_AS(draw_svg(s, {.width = 10}), std::invalid_argument);
    CHECK_THROWS_AS(draw_svg(s, {.coverage = {"beta"}, .cells = 0}), std::invalid_argument);
    CHECK_THROWS_AS(draw_svg(s, {.at = start_of_run - 1s}), std::invalid_argument);
}

TEST_CASE("picture: drawing the links among too many robots is refused") {
    const Scenario s = scenario(
        "[[robot]]\nname = \"r\"\ncount = 5001\n"
        "place = { area = [[\"0 m\", \"0 m\"], [\"9 m\", \"9 m\"]] }\n");
    CHECK_THROWS_WITH_AS(draw_svg(s, {.links = true}), doctest::Contains("at most 5000"), RunError);
}

TEST_CASE("picture: the requested width changes only the number of pixels, not the drawing") {
    const auto body = [](const std::string& svg) { return svg.substr(svg.find("viewBox")); };
    const std::string usual = draw_svg(rescue(), {.axes = true});
    const std::string large = draw_svg(rescue(), {.axes = true, .width = 3000});
    CHECK(body(usual) == body(large));
    CHECK(number(large, "width") == 2.5 * number(usual, "width"));
    CHECK(std::abs(number(large, "height") - 2.5 * number(usual, "height")) < rounding);
}

TEST_CASE("picture: doubling the font size halves the view box, at the same width in pixels") {
    const std::string svg = draw_svg(rescue(), {.width = 600, .font_size = 24});
    CHECK(number(svg, "width") == 600);
    CHECK(has(svg, "viewBox=\"0 0 600 "));
    const std::string usual = draw_svg(rescue(), {.width = 600});
    CHECK(number(usual, "width") == 600);
    CHECK(has(usual, "viewBox=\"0 0 1200 "));
    CHECK_THROWS_AS(draw_svg(rescue(), {.font_size = 0}), std::invalid_argument);
    CHECK_THROWS_AS(draw_svg(rescue(), {.font_size = 100}), std::invalid_argument);
}

TEST_CASE("picture: ticks of the axes are at the coordinates of their labels") {
    const std::string svg =
        draw_svg(scenario(robot("a", 10, 0) + robot("b", 40, 20)), {.axes = true});
    CHECK(has(svg, "x [m]"));
    CHECK(has(svg, "y [m]"));
    CHECK_FALSE(has(draw_svg(scenario(robot("a", 10, 0) + robot("b", 40, 20)), {}), "x [m]"));
    const auto tick = [&](std::string_view text, std::string_view key) {
        const auto end = svg.find(fmt::format(">{}</text>", text));
        REQUIRE(end != svg.npos);
        return number(std::string_view(svg).substr(svg.rfind("<text", end)), key);
    };
    CHECK(std::abs(tick("40", "x") - number(circle_of(svg, "b"), "cx")) < rounding);
    const double baseline = 4;  // [px] from a tick down to its text's baseline
    const double per_metre = (tick("40", "x") - tick("20", "x")) / 20;
    const double up = number(circle_of(svg, "a"), "cy") - number(circle_of(svg, "b"), "cy");
    CHECK(std::abs(up - 20 * per_metre) < 2 * rounding);
    CHECK(std::abs(tick("18", "y") - baseline - number(circle_of(svg, "b"), "cy") - 2 * per_metre) <
          2 * rounding);
}

TEST_CASE("picture: names for which there is no room are counted in the legend") {
    std::string crowd;
    for (int i = 0; i < 40; ++i) crowd += robot(fmt::format("robot number {}", i), 1 + 1e-3 * i, 1);
    CHECK(has(draw_svg(scenario(crowd + robot("far", 500, 1)), {}), "no room for"));
    CHECK_FALSE(has(draw_svg(rescue(), {}), "no room for"));
}

TEST_CASE("picture: a PDF has the same bytes each time, and a pixel becomes a point of 1/72 inch") {
    const std::string svg = draw_svg(rescue(), {.width = 600});
    std::string pdf;
    try {
        pdf = picture_bytes(svg, "p.pdf");
    } catch (const RunError& error) {
        if (!has(error.what(), "librsvg2-bin")) throw;
        MESSAGE("skipped: rsvg-convert is not installed");
        return;
    }
    CHECK(pdf.starts_with("%PDF"));
    CHECK(pdf == picture_bytes(svg, "q.pdf"));
    CHECK(has(unpacked(pdf), "/MediaBox [ 0 0 600 "));
}

TEST_CASE(
    "picture: a PNG has the size of the SVG picture; without rsvg-convert, an error is reported") {
    test::TemporaryFolder folder;
    const std::string svg = draw_svg(rescue(), {.width = 600});
    const std::string path = folder.path("p.png");
    {
        const EmptyPath nothing;
        CHECK_THROWS_WITH_AS(picture_bytes(svg, path), doctest::Contains("librsvg2-bin"), RunError);
    }
    try {
        folder.write("p.png", picture_bytes(svg, path));
    } catch (const RunError& error) {
        if (!has(error.what(), "librsvg2-bin")) throw;
        MESSAGE("skipped: rsvg-convert is not installed");
        return;
    }
    const Image image = read_image(path);
    CHECK(image.width == number(svg, "width"));
    CHECK(image.height == std::lround(number(svg, "height")));
    CHECK_THROWS_WITH_AS(picture_bytes("<svg", path), doctest::Contains("failed"), RunError);
}

}  // namespace picture_test
