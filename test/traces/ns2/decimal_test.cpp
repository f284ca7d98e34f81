// SPDX-License-Identifier: MIT
#include "traces/ns2/decimal.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace decimal_test {
using namespace rovernet;

namespace {

template <class Value>
std::string written(char* (*write)(char*, Value), Value value) {
    char out[longest_decimal];
    return {out, write(out, value)};
}

std::string fixed2(double x) { return written(write_fixed2, x); }

std::string printf2(double x) {
    char out[longest_decimal];
    return {out, out + std::snprintf(out, sizeof out, "%.2f", x)};
}

Time ns(std::int64_t n) { return Time{Duration{n}}; }

/// The first of many values that printf writes otherwise, or "".
template <class Draw>
std::string first_difference(int tries, Draw draw) {
    for (int i = 0; i < tries; ++i) {
        const double x = draw();
        if (fixed2(x) != printf2(x)) return fixed2(x) + " instead of " + printf2(x);
    }
    return "";
}

}  // namespace

TEST_CASE("printing two decimals: exact ties are rounded to the even digit, as by printf") {
    CHECK(fixed2(0.125) == "0.12");
    CHECK(fixed2(0.375) == "0.38");
    CHECK(fixed2(-0.625) == "-0.62");
}

TEST_CASE(
    "printing two decimals: a number that only looks like a tie is rounded by its binary value") {
    CHECK(fixed2(1.005) == "1.00");  // 1.00499999999999989...
    CHECK(fixed2(0.145) == "0.14");  // 0.14499999999999999...
    CHECK(fixed2(0.285) == "0.28");  // 0.284999999999999976; times 100 it rounds to the tie 28.5
    CHECK(fixed2(8.545) == "8.54");
    CHECK(fixed2(1.115) == "1.11");
}

TEST_CASE("printing two decimals: signs, zeros, huge numbers and NaN are printed as by printf") {
    for (const double x :
         {0.0, -0.0, -0.001, 0.01, 99.995, 1e12, 3.9999e13, 4e13, 4.1e13, -1e15,
          1.7976931348623157e308, 5e-324, 2.2250738585072014e-308,
          std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        CHECK(fixed2(x) == printf2(x));
    }
}

TEST_CASE(
    "printing two decimals: the text equals that of printf for random doubles of every magnitude") {
    std::mt19937_64 draw(1);
    CHECK(first_difference(200'000, [&] { return std::bit_cast<double>(draw()); }) == "");
}

TEST_CASE(
    "printing two decimals: the text equals that of printf for ties and the numbers next to them") {
    std::mt19937_64 draw(2);
    const auto near_tie = [&] {
        const auto whole = static_cast<double>(draw() >> (13 + draw() % 50));
        const double tie = (whole + 0.5) / 100;
        switch (draw() % 4) {
            case 0: return std::nextafter(tie, 1e300);
            case 1: return -std::nextafter(tie, -1e300);
            case 2:
                return static_cast<double>(draw() % 1'000'000) +
                       0.125 * static_cast<double>(draw() % 8);
            default: return tie;
        }
    };
    CHECK(first_difference(400'000, near_tie) == "");
}

TEST_CASE("seconds with nine decimals are printed exactly, to the nanosecond") {
    CHECK(written(write_seconds, ns(0)) == "0.000000000");
    CHECK(written(write_seconds, ns(10'000'520'067)) == "10.000520067");
    CHECK(written(write_seconds, ns(-1)) == "-0.000000001");
    CHECK(written(write_seconds, Time::max()) == "9223372036.854775807");
    CHECK(written(write_seconds, Time::min()) == "-9223372036.854775808");
}

TEST_CASE("seconds with five decimals are rounded, ties to the even digit") {
    CHECK(written(write_seconds5, ns(2'000'000'000)) == "2.00000");
    CHECK(written(write_seconds5, ns(4'999)) == "0.00000");
    CHECK(written(write_seconds5, ns(5'000)) == "0.00000");
    CHECK(written(write_seconds5, ns(15'000)) == "0.00002");
    CHECK(written(write_seconds5, ns(25'001)) == "0.00003");
    CHECK(written(write_seconds5, ns(999'995'001)) == "1.00000");
}

TEST_CASE("times in seconds are printed with no more decimals than their value needs") {
    CHECK(written(write_seconds_short, ns(0)) == "0");
    CHECK(written(write_seconds_short, ns(10'000'000'000)) == "10");
    CHECK(written(write_seconds_short, ns(250'000'000)) == "0.25");
    CHECK(written(write_seconds_short, ns(1'001'536'667)) == "1.001536667");
}

TEST_CASE("hexadecimal numbers are written in lower case and without a prefix") {
    CHECK(written(write_hex, std::uint32_t{0}) == "0");
    CHECK(written(write_hex, std::uint32_t{0xABC}) == "abc");
    CHECK(written(write_hex, std::uint32_t{0xffffffff}) == "ffffffff");
}

}  // namespace decimal_test
