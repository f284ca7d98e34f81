// SPDX-License-Identifier: MIT
#include "pictures/draw/plot.hpp"

#include "pictures/draw/label.hpp"
#include "pictures/draw/legend.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace plot_test {
using namespace rovernet;

namespace {

constexpr double rounding = 1e-9;  // [px] of sums of numbers around 1000

bool near(double a, double b) { return std::abs(a - b) <= rounding; }

Extent extent(Vec3 low, Vec3 high) {
    Extent out;
    out.include(low);
    out.include(high);
    return out;
}

}  // namespace

TEST_CASE("plot: an extent (bounding box) includes given discs and points, and can be enlarged") {
    Extent e;
    CHECK(e.empty());
    e.include({1, 2}, 0.5);
    e.include({4, -1});
    CHECK_FALSE(e.empty());
    CHECK(e.low() == Vec3{0.5, -1});
    CHECK(e.high() == Vec3{4, 2.5});
    e.grow(1, 2);
    CHECK(e.width() == 5.5);
    CHECK(e.height() == 7.5);
}

TEST_CASE(
    "plot: a plot fills the given width or height, with y upwards and one scale for both axes") {
    const Plot wide(extent({0, 0}, {20, 10}), {16, 50}, {.width = 1000, .height = 900});
    CHECK(near(wide.scale, 50));
    CHECK((near(wide.width, 1000) && near(wide.height, 500)));
    CHECK((near(wide.at({0, 0}).x, 16) && near(wide.at({0, 0}).y, 550)));
    CHECK((near(wide.at({20, 10}).x, 1016) && near(wide.at({20, 10}).y, 50)));
    const Plot tall(extent({0, 0}, {10, 20}), {16, 50}, {.width = 1000, .height = 900});
    CHECK((near(tall.width, 450) && near(tall.height, 900)));
}

TEST_CASE("plot: an area that is very narrow or very low is centred, with space around it") {
    const Plot low(extent({0, 0}, {100, 1}), {0, 0},
                   {.width = 1000, .height = 800, .least_height = 200});
    CHECK((near(low.height, 200) && near(low.low.y, -9.5) && near(low.high.y, 10.5)));
    CHECK(near(low.at({50, 0.5}).y, 100));
    const Plot narrow(extent({0, 0}, {1, 100}), {0, 0},
                      {.width = 1000, .height = 800, .least_width = 400});
    CHECK((near(narrow.width, 400) && near(narrow.at({0.5, 50}).x, 200)));
}

TEST_CASE("plot: an extent of a single point gives a plot with the point in the middle") {
    Extent e;
    e.include({3, 4});
    const Plot plot(e, {0, 0}, {.width = 1000, .height = 800});
    CHECK(std::isfinite(plot.scale));
    CHECK((near(plot.at({3, 4}).x, plot.width / 2) && near(plot.at({3, 4}).y, plot.height / 2)));
}

TEST_CASE("plot: round numbers are 1, 2 and 5 times a power of ten") {
    CHECK(round_number(1) == 1);
    CHECK(round_number(1.99) == 1);
    CHECK(round_number(2) == 2);
    CHECK(round_number(4.99) == 2);
    CHECK(round_number(50) == 50);
    CHECK(round_number(999) == 500);
    CHECK(round_number(1000) == 1000);
    CHECK(near(round_number(0.3), 0.2));
}

TEST_CASE("plot: ticks are multiples of a round step inside the range, and not too many") {
    CHECK(round_ticks(-100, -30, 9) ==
          std::vector<double>{-100, -90, -80, -70, -60, -50, -40, -30});
    CHECK(round_ticks(-95, -20, 9).front() == -90);
    CHECK(round_ticks(0, 1, 3) == std::vector<double>{0, 0.5, 1});
    CHECK(round_ticks(2, 2, 5) == std::vector<double>{2});
    for (double high = 1; high < 1000; high *= 1.37) {
        const auto ticks = round_ticks(-0.3 * high, high, 8);
        CHECK(ticks.size() >= 3);
        CHECK(ticks.size() <= 8);
    }
}

TEST_CASE("plot: lengths are printed in a suitable unit") {
    CHECK(length_text(2000) == "2 km");
    CHECK(length_text(5) == "5 m");
    CHECK(length_text(0.2) == "20 cm");
    CHECK(length_text(0.005) == "5 mm");
}

TEST_CASE("legend: the scale bar has the length that it states") {
    const Plot plot(extent({0, 0}, {130, 60}), {0, 0}, {.width = 1000, .height = 800});
    const LegendItem bar = scale_bar(plot);
    CHECK(bar.text == "20 m");
    CHECK(near(bar.width, 20 * 1000 / 130.0));
}

TEST_CASE(
    "legend: a legend is as high as its rows, and has a single row if all entries fit into it") {
    Legend legend;
    CHECK(legend.height(500) == 0);
    for (int i = 0; i < 6; ++i) legend.add({.text = "about 60 px", .draw = {}});
    CHECK(legend.height(2000) == 20);
    CHECK(legend.height(300) > 20);
    CHECK(legend.height(10) == 6 * 20);
}

TEST_CASE(
    "legend: a long caption is wrapped between its parts, and a long part between its words") {
    const std::string dot = " \xc2\xb7 ";
    CHECK(wrapped({"one", "two"}, 1000, 12) == std::vector<std::string>{"one" + dot + "two"});
    CHECK(wrapped({"one", "two"}, 30, 12) == std::vector<std::string>{"one", "two"});
    CHECK(wrapped({"one two"}, 30, 12) == std::vector<std::string>{"one", "two"});
    CHECK(wrapped({"indivisible"}, 30, 12) == std::vector<std::string>{"indivisible"});
}

TEST_CASE(
    "label: the positions right, left, above and below are tried in this order, and labels never "
    "overlap") {
    LabelPlaces places({0, 0, 200, 200});
    std::vector<Box> taken;
    for (int i = 0; i < 20; ++i) {
        const auto box = places.place({100, 100}, 5, 30, 12);
        if (!box) break;
        for (const Box& other : taken) CHECK_FALSE(box->overlaps(other));
        CHECK(box->inside({0, 0, 200, 200}));
        taken.push_back(*box);
    }
    REQUIRE(taken.size() >= 4);
    CHECK(taken[0].left == 108);
    CHECK(taken[1].right == 92);
    CHECK(taken[2].bottom == 92);
    CHECK(taken[3].top == 108);
    CHECK(taken.size() < 20);
}

TEST_CASE(
    "label: a label is placed away from the border, from obstacles and, if possible, from lines") {
    LabelPlaces places({0, 0, 400, 100});
    CHECK(places.place({395, 50}, 5, 30, 12)->right < 395);
    places.keep_free({104, 40, 140, 60});
    CHECK(places.place({100, 50}, 5, 30, 12)->right < 100);
    places.avoid({200, 50}, {260, 50});
    CHECK(places.place({200, 50}, 5, 30, 12)->right < 200);
    CHECK_FALSE(LabelPlaces({0, 0, 20, 20}).place({10, 10}, 5, 30, 12));
}

}  // namespace plot_test
