// SPDX-License-Identifier: MIT
#include "scenario/document/quantity.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace quantity_test {
using namespace rovernet;

namespace {

double read(const std::string& text, Dimension dimension) {
    return read_quantity(Value(text), "key", dimension);
}

std::string error_of(Value value, Dimension dimension) {
    try {
        read_quantity(value, "key", dimension);
    } catch (const InputError& error) {
        return error.message();
    }
    return "no error";
}

Value from_option(Value value) {
    value.where = {"--set key", 0, 0, true};
    return value;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("quantity: a value in any unit is converted to its base unit") {
    struct Case {
        const char* text;
        Dimension dimension;
        double expected;
        double tolerance;  // one rounding of the product
    };
    for (const auto& c : std::vector<Case>{{"15 dBm", Dimension::power, 15, 0},
                                           {"1 mW", Dimension::power, 0, 1e-12},
                                           {"1 W", Dimension::power, 30, 1e-12},
                                           {"1 uW", Dimension::power, -30, 1e-12},
                                           {"-2.5 dB", Dimension::gain, -2.5, 0},
                                           {"2 dBi", Dimension::gain, 2, 0},
                                           {"2450 MHz", Dimension::frequency, 2.45e9, 0},
                                           {"2.45 GHz", Dimension::frequency, 2.45e9, 1e-6},
                                           {"3 kHz", Dimension::frequency, 3000, 0},
                                           {"7 Hz", Dimension::frequency, 7, 0},
                                           {"5 m", Dimension::length, 5, 0},
                                           {"2 km", Dimension::length, 2000, 0},
                                           {"5 cm", Dimension::length, 0.05, 1e-15},
                                           {"8 mm", Dimension::length, 0.008, 1e-15},
                                           {"0.5 m/s", Dimension::speed, 0.5, 0},
                                           {"36 km/h", Dimension::speed, 10, 1e-12},
                                           {"3 s", Dimension::time, 3, 0},
                                           {"20 ms", Dimension::time, 0.02, 1e-15},
                                           {"5 us", Dimension::time, 5e-6, 1e-18},
                                           {"6 ns", Dimension::time, 6e-9, 1e-21},
                                           {"2 min", Dimension::time, 120, 0},
                                           {"1 h", Dimension::time, 3600, 0},
                                           {"11 Mb/s", Dimension::bit_rate, 11e6, 0},
                                           {"11 Mbit/s", Dimension::bit_rate, 11e6, 0},
                                           {"5 kb/s", Dimension::bit_rate, 5e3, 0},
                                           {"1 Gb/s", Dimension::bit_rate, 1e9, 0},
                                           {"9 b/s", Dimension::bit_rate, 9, 0},
                                           {"64 B", Dimension::size, 64, 0},
                                           {"2 kB", Dimension::size, 2000, 0},
                                           {"2 KiB", Dimension::size, 2048, 0},
                                           {"1 MB", Dimension::size, 1e6, 0}}) {
        CAPTURE(c.text);
        CHECK(std::abs(read(c.text, c.dimension) - c.expected) <= c.tolerance);
    }
}

TEST_CASE("quantity: blanks around number and unit, a plus sign and exponents are accepted") {
    CHECK(read(" 5m ", Dimension::length) == 5);
    CHECK(read("+5 m", Dimension::length) == 5);
    CHECK(read("5\tm", Dimension::length) == 5);
    CHECK(read("5e-1 m", Dimension::length) == 0.5);
    CHECK(read("-80dBm", Dimension::power) == -80);
}

TEST_CASE(
    "quantity: conversion of a unit that is a power of ten, such as cm to m, is exact to the last "
    "bit") {
    struct Case {
        const char* unit;
        int exponent;
        const char* base;
        Dimension dimension;
    };
    const Case cases[] = {{"cm", -2, "m", Dimension::length},
                          {"mm", -3, "m", Dimension::length},
                          {"km", 3, "m", Dimension::length},
                          {"ms", -3, "s", Dimension::time},
                          {"us", -6, "s", Dimension::time},
                          {"ns", -9, "s", Dimension::time},
                          {"GHz", 9, "Hz", Dimension::frequency},
                          {"MHz", 6, "Hz", Dimension::frequency},
                          {"kb/s", 3, "b/s", Dimension::bit_rate},
                          {"MB", 6, "B", Dimension::size},
                          {"dB/cm", 2, "dB/m", Dimension::attenuation}};
    for (const auto& c : cases) {
        int wrong = 0;
        for (int hundredths = 1; hundredths < 40'000; hundredths += 7) {
            const std::string number = std::to_string(hundredths / 100) + "." +
                                       std::to_string(100 + hundredths % 100).substr(1);
            const std::string moved = number + "e" + std::to_string(c.exponent) + " " + c.base;
            wrong += read(number + " " + c.unit, c.dimension) != read(moved, c.dimension);
        }
        CAPTURE(c.unit);
        CHECK(wrong == 0);
    }
    CHECK(read("3730 cm", Dimension::length) == 37.3);
    CHECK(read("3.73e3 cm", Dimension::length) == 37.3);
    CHECK(read("-7 mm", Dimension::length) == -0.007);
    CHECK(read("1e9 W", Dimension::power) == read("1e12 mW", Dimension::power));
    CHECK(read("5 uW", Dimension::power) == read("0.005 mW", Dimension::power));
}

TEST_CASE("quantity: a speed in km/h is converted to m/s with a single rounding") {
    int wrong = 0;
    for (int tenths = 1; tenths < 40'000; ++tenths) {
        const std::string text =
            std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " km/h";
        wrong += read(text, Dimension::speed) != tenths / 36.0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("quantity: a power that is too small to have a level in dBm is refused") {
    CHECK(contains(error_of("1e-322 uW", Dimension::power), "which has no level"));
}

TEST_CASE(
    "quantity: a number without a unit is an error in a file, and the error suggests a unit") {
    const Value bare_numbers[] = {Value(5), Value(5.0), Value("5")};
    for (const auto& value : bare_numbers) {
        const std::string error = error_of(value, Dimension::length);
        CHECK(contains(error, "the number 5 without a unit"));
        CHECK(contains(error, "did you mean \"5 m\"?"));
    }
}

TEST_CASE("quantity: in an option a number without a unit is in SI units, a power in watts") {
    CHECK(read_quantity(from_option(5), "key", Dimension::length) == 5);
    CHECK(read_quantity(from_option("2.45e9"), "key", Dimension::frequency) == 2.45e9);
    CHECK(std::abs(read_quantity(from_option(0.1), "key", Dimension::power) - 20) < 1e-12);
    CHECK(contains(error_of(from_option(0), Dimension::power), "which has no level"));
}

TEST_CASE("quantity: a misspelt unit gets a suggestion") {
    CHECK(contains(error_of("2.4 ghz", Dimension::frequency), "did you mean \"GHz\"?"));
    CHECK(contains(error_of("5 DBM", Dimension::power), "did you mean \"dBm\"?"));
    CHECK(contains(error_of("11 Mbps", Dimension::bit_rate), "did you mean \"Mb/s\"?"));
    CHECK(contains(error_of("15,5 dBm", Dimension::power), "decimal point"));
}

TEST_CASE("quantity: dBW is refused, with the same power in dBm as a suggestion") {
    const std::string error = error_of("-15 dBW", Dimension::power);
    CHECK(contains(error, "found the unit \"dBW\""));
    CHECK(contains(error, "a different unit: -15 dBW is \"15 dBm\""));
}

TEST_CASE("quantity: a value that is not a finite number is an error") {
    for (const char* text : {"", "m", "nan m", "inf m", "-inf m", "1e999 m", "1e308 km", "five m",
                             "5 m m", "5 5 m", "- 5 m", "0x10 m"}) {
        CAPTURE(text);
        CHECK(contains(error_of(text, Dimension::length), "key: found"));
    }
    const double nan = std::nan("");
    for (const Dimension dimension : {Dimension::length, Dimension::power}) {
        CHECK(contains(error_of(nan, dimension), "found the number nan; expected a"));
        CHECK(contains(error_of(from_option(nan), dimension), "found the number nan; expected a"));
        CHECK(!contains(error_of(from_option(nan), dimension), "did you mean"));
    }
    CHECK(contains(error_of(from_option(HUGE_VAL), Dimension::power), "at most"));
}

TEST_CASE("quantity: a length whose square overflows is refused (S38)") {
    CHECK(contains(error_of("1e200 m", Dimension::length), "a length of at most 1e6 km"));
    CHECK(contains(error_of("-1e200 m", Dimension::length), "a length of at most 1e6 km"));
}

TEST_CASE("quantity: the text of a quantity reads back as the same number, to the last bit") {
    const double numbers[] = {
        0, 1, -75, 16.532125137753436, 0.1, 1.0 / 3, 0.5, 5e-9, 4321.78901, 1e-300, -1e-7, 9999.5};
    for (const double hertz : {2.45e9, 2450.5e6, 1e15}) {
        CHECK(read(quantity_text(hertz, Dimension::frequency), Dimension::frequency) == hertz);
    }
    for (int d = 0; d <= static_cast<int>(Dimension::size); ++d) {
        for (const double number : numbers) {
            const auto dimension = static_cast<Dimension>(d);
            const std::string text = quantity_text(number, dimension);
            CAPTURE(text);
            CHECK(read(text, dimension) == number);
        }
    }
}

}  // namespace quantity_test
