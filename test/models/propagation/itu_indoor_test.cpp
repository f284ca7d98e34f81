// SPDX-License-Identifier: MIT
#include "models/propagation/itu_indoor.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace itu_indoor_test {
using namespace rovernet;
using test::loss_at;
using test::near;

namespace {

/// A few roundings of losses up to 200 dB.
constexpr double tolerance = 1e-12;  // [dB]

ItuIndoor indoor(std::optional<double> coefficient, std::optional<Environment> environment = {},
                 std::optional<int> floors = {}) {
    return {.coefficient = coefficient, .environment = environment, .floors = floors};
}

std::optional<Environment> environment_of(const std::string& name) {
    for (const auto e : {Environment::residential, Environment::office, Environment::commercial}) {
        if (name.rfind(name_of(e), 0) == 0) return e;
    }
    return std::nullopt;
}

/// "office 2 floors" has two.
int floors_of(const std::string& name) {
    const auto word = name.find(" floor");
    return word == std::string::npos ? 0 : name[word - 1] - '0';
}

/// Loss [dB] at d = 10 m between heights [m], storeys of 3 m.
double between(const ItuIndoor& model, double z1, double z2) {
    const double d2 = 100 - (z1 - z2) * (z1 - z2);
    return test::OneLink{.frequency = {1900e6}, .from = {0, 0, z1}, .to = {std::sqrt(d2), 0, z2}}
        .loss(model);
}

}  // namespace

TEST_CASE(
    "itu_indoor: for each environment, frequency and number of floors, losses equal the test "
    "vectors") {
    const test::Vectors vectors("p1238_classic.csv");
    int used = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const auto& name = vectors.text(i, "env");
        const auto environment = environment_of(name);
        const double d = vectors.number(i, "d_m");
        const Hertz f{1e6 * vectors.number(i, "f_MHz")};
        CAPTURE(name);
        CAPTURE(f.value);
        CAPTURE(d);
        if (!environment || d < 1) continue;
        ++used;
        const ItuIndoor model = indoor({}, environment, floors_of(name));
        CHECK_NOTHROW(model.check_frequency(f));
        CHECK(near(loss_at(model, d, f), vectors.number(i, "L_dB"), test::vector_tolerance));
    }
    CHECK(used > 60);
}

TEST_CASE(
    "itu_indoor: with a given coefficient, losses equal the test vectors without floor losses") {
    const test::Vectors vectors("p1238_classic.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_m");
        if (d < 1) continue;
        const ItuIndoor model = indoor(vectors.number(i, "N"));
        const double expected = vectors.number(i, "L_dB") - vectors.number(i, "Lf_dB");
        CHECK(near(loss_at(model, d, {1e6 * vectors.number(i, "f_MHz")}), expected,
                   test::vector_tolerance));
    }
}

TEST_CASE("itu_indoor: without coefficient and environment, the coefficient N is 30") {
    CHECK(loss_at(ItuIndoor{}, 25) == loss_at(indoor(30), 25));
    CHECK(near(loss_at(ItuIndoor{}, 100) - loss_at(ItuIndoor{}, 10), 30, tolerance));
}

TEST_CASE("itu_indoor: a given coefficient overrides the coefficient of the environment") {
    const ItuIndoor both = indoor(40, Environment::office);
    CHECK(near(loss_at(both, 100) - loss_at(both, 10), 40, tolerance));
}

TEST_CASE("itu_indoor: below 1 m the loss is the value at 1 m") {
    const double at_1_m = loss_at(ItuIndoor{}, 1);
    for (const double d : {0.0, 1e-12, 0.5, 0.999}) CHECK(loss_at(ItuIndoor{}, d) == at_1_m);
    CHECK(loss_at(ItuIndoor{}, 1.001) > at_1_m);
}

TEST_CASE(
    "itu_indoor: a frequency must be within a factor of 1.5 of a frequency in the environment's "
    "table") {
    const ItuIndoor office = indoor({}, Environment::office);
    CHECK_NOTHROW(office.check_frequency(601_MHz));
    CHECK_THROWS_AS(office.check_frequency(599_MHz), std::invalid_argument);
    CHECK_NOTHROW(office.check_frequency(7799_MHz));
    CHECK_THROWS_AS(office.check_frequency(7801_MHz), std::invalid_argument);
    CHECK_THROWS_AS(office.check_frequency(39'999_MHz), std::invalid_argument);
    const ItuIndoor shop = indoor({}, Environment::commercial);
    CHECK_THROWS_AS(shop.check_frequency(6001_MHz), std::invalid_argument);
    const ItuIndoor home = indoor({}, Environment::residential);
    CHECK_THROWS_AS(home.check_frequency(868_MHz), std::invalid_argument);
}

TEST_CASE("itu_indoor: with a given coefficient any frequency is accepted") {
    CHECK_NOTHROW(indoor(30).check_frequency(1_MHz));
    const ItuIndoor both = indoor(30, Environment::office);
    CHECK_NOTHROW(both.check_frequency(20'000_MHz));
}

TEST_CASE(
    "itu_indoor: floors are refused without an environment, or if the table has no loss for them") {
    CHECK_THROWS_AS(indoor({}, {}, 1).check_frequency(2450_MHz), std::invalid_argument);
    const ItuIndoor two = indoor({}, Environment::office, 2);
    CHECK_THROWS_AS(two.check_frequency(2450_MHz), std::invalid_argument);
    CHECK_NOTHROW(two.check_frequency(1900_MHz));
    const ItuIndoor four = indoor({}, Environment::office, 4);
    CHECK_THROWS_AS(four.check_frequency(900_MHz), std::invalid_argument);
}

TEST_CASE("itu_indoor: zero floors cost nothing, in any environment") {
    for (const auto e : {Environment::residential, Environment::office, Environment::commercial}) {
        const auto unsaid = indoor({}, e), none = indoor({}, e, 0);
        CHECK(near(loss_at(none, 1, 1900_MHz), 20 * std::log10(1900.0) - 28, tolerance));
        CHECK(loss_at(unsaid, 20, 1900_MHz) == loss_at(none, 20, 1900_MHz));
    }
}

TEST_CASE("itu_indoor: the number of floors follows from the storeys of the two antennas") {
    const ItuIndoor office = indoor({}, Environment::office);
    const double same = between(office, 1, 2.9);
    CHECK(near(between(office, 2.9, 3.1) - same, 15, tolerance));  // Lf = 15 + 4 (n - 1)
    CHECK(near(between(office, 1, 7) - same, 19, tolerance));
    CHECK(near(between(office, 7, 1) - same, 19, tolerance));
    CHECK(near(between(office, -1, 1) - same, 15, tolerance));  // a cellar
    CHECK(near(between(office, 3, 5.9) - same, 0, tolerance));
}

TEST_CASE(
    "itu_indoor: heights have no effect if only a coefficient, or the number of floors, is given") {
    CHECK(near(between(indoor(30), 1, 7), between(indoor(30), 1, 1), tolerance));
    const ItuIndoor one = indoor({}, Environment::office, 1);
    CHECK(near(between(one, 1, 7), between(one, 1, 1), tolerance));
}

TEST_CASE(
    "itu_indoor: for more floors than the table has, the loss of the last table entry is used") {
    const ItuIndoor office = indoor({}, Environment::office);
    const auto rise = [&](double z) {
        return test::OneLink{.frequency = {900e6}, .to = {40, 0, z}}.loss(office) -
               loss_at(office, std::sqrt(1600 + z * z), 900_MHz);
    };
    CHECK(near(rise(9), 24, tolerance));   // three floors
    CHECK(near(rise(30), 24, tolerance));  // ten
}

}  // namespace itu_indoor_test
