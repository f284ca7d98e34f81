// SPDX-License-Identifier: MIT
#include "pictures/chart/chart_axis.hpp"

#include "sim/math.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace chart_axis_test {
using namespace rovernet;

namespace {

constexpr double rounding = 1e-12;  // of shares: a few operations on numbers near 1

ChartRange range(std::initializer_list<double> values) {
    ChartRange out;
    for (const double v : values) out.include(v);
    return out;
}

std::vector<std::string> texts(const ChartAxis& axis) {
    std::vector<std::string> out;
    for (const auto& tick : axis.ticks) {
        if (!tick.text.empty()) out.push_back(tick.text);
    }
    return out;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("chart axis: ticks are multiples of 1, 2 or 5 times a power of ten, within the limits") {
    for (double size = 1e-9; size < 1e9; size *= 3.7) {
        const ChartAxis axis = number_axis(range({-0.3 * size, size}), false, 8);
        const double step = axis.ticks[1].value - axis.ticks[0].value;
        const double digits = step / math::exp10(std::floor(math::log10(step * (1 + rounding))));
        CHECK((std::abs(digits - 1) < 1e-9 || std::abs(digits - 2) < 1e-9 ||
               std::abs(digits - 5) < 1e-9));
        CHECK(axis.ticks.size() >= 3);
        CHECK(axis.ticks.size() <= 8);
        CHECK(axis.low <= -0.3 * size);
        CHECK(axis.high >= size);
        for (const auto& tick : axis.ticks) {
            CHECK(tick.value >= axis.low);
            CHECK(tick.value <= axis.high);
            const double steps = tick.value / step;
            CHECK(std::abs(steps - std::round(steps)) < 1e-9);
        }
    }
}

TEST_CASE("chart axis: an axis ends at a tick, or slightly beyond its last tick") {
    const ChartAxis at_ticks = number_axis(range({2, 97}), false, 11);
    CHECK((at_ticks.low == 0 && at_ticks.high == 100));
    const ChartAxis beyond = number_axis(range({-0.01, 1.01}), false, 7);
    CHECK(texts(beyond) == Texts{"0", "0.2", "0.4", "0.6", "0.8", "1.0"});
    CHECK((beyond.low < -0.01 && beyond.low > -0.05));
    CHECK((beyond.high > 1.01 && beyond.high < 1.05));
}

TEST_CASE(
    "chart axis: the axis of a ratio goes from 0 to 1; if all values are close together, it is "
    "shorter") {
    const ChartLimits share{.low = 0, .high = 1};
    const ChartAxis wide = number_axis(range({0.4, 0.7}), false, 6, share);
    CHECK((wide.low == 0 && wide.high == 1));
    CHECK(texts(wide) == Texts{"0", "0.2", "0.4", "0.6", "0.8", "1.0"});
    const ChartAxis narrow = number_axis(range({0.62, 0.7}), false, 6, share);
    CHECK((narrow.low > 0.5 && narrow.high < 0.8));
    const ChartAxis whole = number_axis(range({0, 1}), false, 6, share);
    CHECK(texts(whole).size() == 6);
}

TEST_CASE(
    "chart axis: the axis of a quantity with natural limits, such as 0 and 1, stays within them") {
    const ChartLimits share{.low = 0, .high = 1}, positive{.low = 0};
    for (const auto& each : {range({0.93, 0.999}), range({0.99, 1}), range({1, 1}), range({0, 0}),
                             range({0, 0.01}), range({0.0001, 0.13}), range({0.9999, 1})}) {
        const ChartAxis axis = number_axis(each, false, 6, share);
        CHECK((axis.low >= 0 && axis.high <= 1));
        CHECK((axis.low <= each.low() + rounding && axis.high >= each.high() - rounding));
        CHECK(axis.ticks.size() >= 2);
        for (const ChartTick& tick : axis.ticks) CHECK((tick.value >= 0 && tick.value <= 1));
    }
    for (const auto& each : {range({0.001, 5}), range({0, 0}), range({3e-9, 4e-9})}) {
        const ChartAxis axis = number_axis(each, false, 6, positive);
        CHECK((axis.low >= 0 && axis.low <= each.low() && axis.high >= each.high()));
    }
    CHECK(number_axis(range({0.1, 0.9}), true, 6, share).high == 1);
}

TEST_CASE("chart axis: a value beyond the natural limits of its quantity extends the axis") {
    const ChartAxis axis = number_axis(range({-0.3, 1.2}), false, 6, {.low = 0, .high = 1});
    CHECK((axis.low <= -0.3 && axis.high >= 1.2));
}

TEST_CASE(
    "chart axis: the position on a linear axis follows the value, on a log axis its logarithm") {
    const ChartAxis linear = number_axis(range({-10, 30}), false, 6);
    CHECK(std::abs(linear.share(0) - 0.25) < rounding);
    CHECK((linear.share(-1e9) == 0 && linear.share(1e9) == 1));
    const ChartAxis log = number_axis(range({0.01, 100}), true, 8);
    CHECK((log.low == 0.01 && log.high == 100));
    CHECK(std::abs(log.share(1) - 0.5) < rounding);
    CHECK(std::abs(log.share(10) - 0.75) < rounding);
    CHECK((log.share(0) == 0 && log.share(-1) == 0));
}

TEST_CASE(
    "chart axis: a long log axis has labels at 1, 10, 100 ..., a short log axis at 1, 2, 5, 10, 20 "
    "...") {
    CHECK(texts(number_axis(range({0.001, 1e4}), true, 8)) == Texts{"0.001", "0.01", "0.1", "1",
                                                                    "10", "100", "1000",
                                                                    "10\xc2\xa0"
                                                                    "000"});
    CHECK(texts(number_axis(range({1, 40}), true, 8)) == Texts{"1", "2", "5", "10", "20", "50"});
    CHECK(texts(number_axis(range({2, 4}), true, 8)) == Texts{"2", "5"});
    CHECK(texts(number_axis(range({1e-6, 1e6}), true, 5)) ==
          Texts{"1e-6", "0.001", "1", "1000", "1e6"});
    for (const int most : {3, 4, 5, 8}) {
        const auto found = texts(number_axis(range({1e-100, 1e100}), true, most));
        CHECK(static_cast<int>(found.size()) <= most);
        CHECK(static_cast<int>(found.size()) > most / 2);
    }
}

TEST_CASE("chart axis: a log axis has minor ticks at 2 to 9 times a power of ten") {
    const ChartAxis axis = number_axis(range({1, 10}), true, 3);
    REQUIRE(axis.ticks.size() == 10);
    for (int i = 0; i < 9; ++i) CHECK(axis.ticks[static_cast<std::size_t>(i)].value == i + 1);
}

TEST_CASE(
    "chart axis: with no values, with equal values and with huge values, the axis is still valid") {
    const double least = std::numeric_limits<double>::denorm_min();
    for (const auto& each : {range({}), range({0}), range({5}), range({-5, -5}), range({1e100}),
                             range({-1e100, 1e100}), range({1, 1 + 1e-16}),
                             range({1e9, 1e9 + 1e-3}), range({0, least}), range({1e-99})}) {
        const ChartAxis axis = number_axis(each, false, 5);
        CHECK(std::isfinite(axis.low));
        CHECK(axis.low < axis.high);
        CHECK(axis.ticks.size() >= 2);
        CHECK((axis.share(each.low()) >= 0 && axis.share(each.high()) <= 1));
        CHECK(axis.low <= each.low());
        CHECK(axis.high >= each.high());
    }
    const ChartAxis log = number_axis(range({7, 7}), true, 5);
    CHECK((log.low < 7 && log.high > 7));
}

TEST_CASE(
    "chart axis: tick labels have as many digits as the distance between the ticks requires") {
    CHECK(texts(number_axis(range({0, 50'000}), false, 6)) == Texts{"0",
                                                                    "10\xc2\xa0"
                                                                    "000",
                                                                    "20\xc2\xa0"
                                                                    "000",
                                                                    "30\xc2\xa0"
                                                                    "000",
                                                                    "40\xc2\xa0"
                                                                    "000",
                                                                    "50\xc2\xa0"
                                                                    "000"});
    CHECK(texts(number_axis(range({0, 4e6}), false, 5)) == Texts{"0", "1e6", "2e6", "3e6", "4e6"});
    CHECK(texts(number_axis(range({1.5e6, 3e6}), false, 4)) ==
          Texts{"1.5e6", "2e6", "2.5e6", "3e6"});
    CHECK(texts(number_axis(range({-2e-5, 2e-5}), false, 5)) ==
          Texts{"-2e-5", "-1e-5", "0", "1e-5", "2e-5"});
    CHECK(texts(number_axis(range({99.5, 100.5}), false, 3)) == Texts{"99.5", "100.0", "100.5"});
}

TEST_CASE(
    "chart axis: a printed value has enough digits to resolve 1/100 of the range of the axis") {
    const ChartAxis axis = number_axis(range({0, 1}), false, 6);
    CHECK(axis.text(0.126) == "0.13");
    CHECK(axis.text(1) == "1.00");
    CHECK(axis.text(0.004) == "0");
    CHECK(number_axis(range({0, 2000}), false, 6).text(1234.4) == "1234");
}

TEST_CASE("chart axis: numbers are rounded to four digits or to integers, without needless zeros") {
    CHECK(number_text(0) == "0");
    CHECK(number_text(0.25) == "0.25");
    CHECK(number_text(-3.14159) == "-3.142");
    CHECK(number_text(1234) == "1234");
    CHECK(number_text(12345.6) ==
          "12\xc2\xa0"
          "346");
    CHECK(number_text(-123456) ==
          "-123\xc2\xa0"
          "456");
    CHECK(number_text(1.5e6) == "1.5e6");
    CHECK(number_text(2e100) == "2e100");
    CHECK(number_text(-1.2344e-7) == "-1.234e-7");
    CHECK(number_text(0.0001) == "0.0001");
}

TEST_CASE("chart axis: if all values are whole numbers, no tick is at a fraction") {
    ChartRange few;
    for (const double v : {1, 2, 3, 4, 6}) few.include(v);
    for (const ChartTick& tick : number_axis(few, false, 12).ticks) {
        CHECK(tick.value == std::floor(tick.value));
        CHECK(tick.text.find('.') == std::string::npos);
    }
    few.include(2.5);
    CHECK_FALSE(few.whole());
}

TEST_CASE(
    "chart axis: an axis of words has equal parts, and each word is in the middle of its part") {
    const ChartAxis axis = word_axis({"a", "b", "c", "d"});
    CHECK(std::abs(axis.share(0) - 0.125) < rounding);
    CHECK(std::abs(axis.share(3) - 0.875) < rounding);
    CHECK(texts(axis) == Texts{"a", "b", "c", "d"});
    CHECK(word_axis({}).low < word_axis({}).high);
}

}  // namespace chart_axis_test
