// SPDX-License-Identifier: MIT
#include "models/propagation/two_ray.hpp"

#include "models/propagation/friis.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace two_ray_test {
using namespace rovernet;
using test::near;

namespace {

/// A few roundings of losses up to 200 dB.
constexpr double tolerance = 1e-12;  // [dB]
/// The files of the peers carry ten digits of levels above -1000 dBm.
constexpr double peer_tolerance = 1e-6;  // [dB]

/// Between antennas at heights ht and hr [m] whose feet are d [m] apart.
double loss_over_ground(double ht, double hr, double d, Hertz f, const TwoRay& model = {}) {
    return test::OneLink{.frequency = f, .from = {0, 0, ht}, .to = {d, 0, hr}}.loss(model);
}

/// ns-2's speed of light, as a frequency at which ours gives the same wavelength.
Hertz with_speed_of_ns2(double f) { return {f * (speed_of_light / 3e8)}; }

/// The number behind `name=` in a peer's parameters.
double parameter(const std::string& text, const std::string& name) {
    return std::stod(text.substr(text.find(name + "=") + name.size() + 1));
}

}  // namespace

TEST_CASE("two-ray: losses equal the test vectors") {
    const test::Vectors vectors("two_ray.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_ground_m");
        const double f = vectors.number(i, "f_Hz");
        CAPTURE(d);
        CAPTURE(f);
        const double loss =
            loss_over_ground(vectors.number(i, "ht_m"), vectors.number(i, "hr_m"), d, {f});
        CHECK(near(loss, vectors.number(i, "ns2_simplified_dB"), test::vector_tolerance));
    }
}

TEST_CASE("two-ray, exact: losses equal the test vectors, for three kinds of ground reflection") {
    const test::Vectors vectors("two_ray.csv");
    const TwoRay horizontal{.form = TwoRayForm::exact, .polarization = Polarization::horizontal};
    const TwoRay vertical{.form = TwoRayForm::exact};
    TwoRay mirror = horizontal;
    mirror.ground_permittivity = 1e300;  // reflects all, with the opposite sign
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double d = vectors.number(i, "d_ground_m"), ht = vectors.number(i, "ht_m");
        const double hr = vectors.number(i, "hr_m");
        const Hertz f{vectors.number(i, "f_Hz")};
        CAPTURE(d);
        CAPTURE(ht);
        const auto is_near = [&](const TwoRay& model, const char* column) {
            return near(loss_over_ground(ht, hr, d, f, model), vectors.number(i, column),
                        test::vector_tolerance);
        };
        CHECK(is_near(mirror, "exact_G-1_dB"));
        CHECK(is_near(horizontal, "exact_eps15_H_dB"));
        CHECK(is_near(vertical, "exact_eps15_V_dB"));
    }
}

TEST_CASE("two-ray, exact: far away the loss grows with the fourth power of the distance") {
    TwoRay mirror{.form = TwoRayForm::exact, .polarization = Polarization::horizontal};
    mirror.ground_permittivity = 1e300;
    // (d^2 / (ht hr))^2; what is left out falls with (ht / d)^2 and (k ht hr / d)^2.
    CHECK(near(loss_over_ground(1.5, 1.5, 1e8, 2450_MHz, mirror),
               20 * std::log10(1e16 / (1.5 * 1.5)), 1e-6));
}

TEST_CASE("two-ray, exact: a ground with the permittivity of air reflects nothing") {
    const TwoRay air{.form = TwoRayForm::exact, .ground_permittivity = 1};
    for (const double d : {1.0, 30.0, 1e4}) {
        const double slant = std::hypot(d, 1.0);
        CHECK(near(loss_over_ground(3, 2, d, 2450_MHz, air), free_space_db(slant, 2450_MHz),
                   tolerance));
    }
}

TEST_CASE("two-ray: levels equal those of ns-2.35, if the speed of light of ns-2 is used") {
    const test::Vectors vectors("peer_ns2_loss.csv");
    int compared = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (vectors.text(i, "model") != "TwoRayGround") continue;
        const double d = vectors.number(i, "d_m");
        CAPTURE(d);
        const Hertz f = with_speed_of_ns2(vectors.number(i, "freq_hz"));
        const double level = vectors.number(i, "tx_dbm") - loss_over_ground(1.5, 1.5, d, f);
        CHECK(near(level, vectors.number(i, "rx_dbm"), peer_tolerance));
        ++compared;
    }
    CHECK(compared == 54);
}

TEST_CASE("two-ray: beyond 0.5 m levels equal those of ns-3.37, at three heights") {
    const test::Vectors vectors("peer_ns3_loss.csv");
    int compared = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (vectors.text(i, "model") != "TwoRayGroundPropagationLossModel") continue;
        const std::string& text = vectors.text(i, "params");
        const double d = vectors.number(i, "d_m");
        if (d <= 0.5) continue;  // the peer loses nothing there
        CAPTURE(text);
        CAPTURE(d);
        const double above = parameter(text, "HeightAboveZ");
        const double loss =
            loss_over_ground(above + parameter(text, "zA"), above + parameter(text, "zB"), d,
                             {vectors.number(i, "freq_hz")});
        CHECK(
            near(vectors.number(i, "tx_dbm") - loss, vectors.number(i, "rx_dbm"), peer_tolerance));
        ++compared;
    }
    CHECK(compared >= 120);
}

TEST_CASE("two-ray: ns-2's radio of 914 MHz receives at 250 m and senses at 550 m") {
    constexpr double half_a_digit = 0.5e-5;  // of 3.65262e-10 W and 1.55924e-11 W, relative
    constexpr double power = 0.28183815;     // [W]
    const auto received = [](double d) {
        return power * std::pow(10, -loss_over_ground(1.5, 1.5, d, 914_MHz) / 10);
    };
    CHECK(near(received(250) / 3.65262e-10, 1, half_a_digit));
    CHECK(near(received(550) / 1.55924e-11, 1, half_a_digit));
}

TEST_CASE(
    "two-ray: up to the crossover distance the loss is that of free space, without a step there") {
    const double crossover = 4 * std::numbers::pi * 1.5 * 1.5 / (speed_of_light / 914e6);  // 86.2 m
    for (const double d : {0.0, 1.0, 40.0, 0.999999 * crossover}) {
        CHECK(loss_over_ground(1.5, 1.5, d, 914_MHz) == test::loss_at(Friis{}, d, 914_MHz));
    }
    const double hair = 1e-9;
    CHECK(near(loss_over_ground(1.5, 1.5, crossover * (1 + hair), 914_MHz),
               loss_over_ground(1.5, 1.5, crossover * (1 - hair), 914_MHz), 60 * hair));
}

TEST_CASE(
    "two-ray: beyond the crossover twice the distance costs 40 log10(2) dB at any frequency") {
    const auto loss = [](double d, Hertz f) { return loss_over_ground(1.5, 1.5, d, f); };
    CHECK(near(loss(2000, 914_MHz) - loss(1000, 914_MHz), 40 * std::log10(2.0), tolerance));
    CHECK(near(loss(2000, 914_MHz), loss(2000, 2450_MHz), tolerance));
}

TEST_CASE("two-ray: beyond the crossover, doubling the height of an antenna saves 20 log10(2) dB") {
    const double flat = 1e-5;  // [dB] the slant distance grows by 6 m over 10 km
    CHECK(near(loss_over_ground(1, 2, 1e4, 914_MHz) - loss_over_ground(1, 4, 1e4, 914_MHz),
               20 * std::log10(2.0), flat));
}

TEST_CASE(
    "two-ray: an antenna lower than the parameter lowest_antenna has the height lowest_antenna") {
    for (const double z : {0.0, -0.0, -1.0, -1e6, 0.05}) {
        CHECK(loss_over_ground(z, z, 100, 2450_MHz) == loss_over_ground(0.1, 0.1, 100, 2450_MHz));
    }
    constexpr double flat = 1e-5;  // [dB] the slant distance differs by 0.5 mm over 10 km
    CHECK(near(loss_over_ground(-3, 1.5, 1e4, 2450_MHz), loss_over_ground(0.1, 1.5, 1e4, 2450_MHz),
               flat));
    const TwoRay high{.lowest_antenna = 1.5_m};
    CHECK(loss_over_ground(0, 0, 250, 914_MHz, high) == loss_over_ground(1.5, 1.5, 250, 914_MHz));
}

TEST_CASE(
    "two-ray: the loss is equal in both directions to the last bit, also beyond the crossover") {
    for (int i = 0; i < 1000; ++i) {
        const double ht = 0.1 + 0.00317 * i, hr = 2.9 - 0.00213 * i;
        CHECK(loss_over_ground(ht, hr, 3e3, 2450_MHz) == loss_over_ground(hr, ht, 3e3, 2450_MHz));
    }
}

TEST_CASE("two-ray: at the same distance, a higher antenna may have less loss") {
    CHECK(loss_over_ground(1.5, 3, 500, 914_MHz) < loss_over_ground(1.5, 1.5, 500, 914_MHz));
    CHECK(Propagation(TwoRay{}).shape() == LossShape::by_heights);
}

TEST_CASE(
    "two-ray: if the greatest antenna height is given, the reach is exact for antennas at this "
    "height") {
    for (const double highest : {-2.0, 0.5, 1.5, 30.0}) {
        const double h = std::max(highest, 0.1);
        for (const double budget : {40.0, 80.0, 95.0, 140.0}) {
            const double reach = TwoRay{}.reach({budget}, 914_MHz, {highest}).value;
            CHECK(loss_over_ground(h, h, reach * (1 - 1e-9), 914_MHz) <= budget);
            CHECK(loss_over_ground(h, h, reach * (1 + 1e-9), 914_MHz) > budget);
            CHECK(reach <= Friis{}.reach({budget}, 914_MHz).value);
        }
    }
    // ns-2's radio of 24.5 dBm with thresholds of -64.37 and -78.07 dBm.
    CHECK(TwoRay{}.reach(88.87437_dB, 914_MHz, 1.5_m).value == doctest::Approx(250).epsilon(1e-4));
    CHECK(TwoRay{}.reach(102.57078_dB, 914_MHz, 1.5_m).value == doctest::Approx(550).epsilon(1e-4));
}

TEST_CASE("two-ray: if no greatest antenna height is given, the reach is that of free space") {
    const Propagation model = TwoRay{};
    CHECK(model.reach(80_dB, 2450_MHz) == Friis{}.reach(80_dB, 2450_MHz));
}

TEST_CASE(
    "two-ray, exact: for low antennas kilometres apart, the loss is right within 1e-4 dB (S08)") {
    TwoRay mirror{.form = TwoRayForm::exact, .polarization = Polarization::horizontal};
    mirror.ground_permittivity = 1e300;
    struct Row {
        double d, h, loss;
    };
    // A difference of the two ways in single precision is up to 0.15 dB off, or infinite.
    for (const Row& row :
         {Row{1e3, 0.3, 140.9152}, Row{1e4, 0.3, 180.9152}, Row{1e4, 1.5, 152.9565},
          Row{1e5, 1.5, 192.9564}, Row{1e8, 0.3, 340.9151}}) {
        CAPTURE(row.d);
        constexpr double half_a_digit = 1e-4;  // [dB], and the last phase before the far field
        CHECK(
            near(loss_over_ground(row.h, row.h, row.d, 2450_MHz, mirror), row.loss, half_a_digit));
    }
}

TEST_CASE("two-ray, exact: at the last null before the far field, the loss is 110 dB (S09)") {
    TwoRay mirror{.form = TwoRayForm::exact, .polarization = Polarization::horizontal};
    mirror.ground_permittivity = 1e300;
    constexpr double half_a_digit = 0.005;  // [dB]
    CHECK(near(loss_over_ground(1.5, 1.5, 36, Hertz{2398339664.0}, mirror), 110.04, half_a_digit));
}

TEST_CASE("two-ray, exact: for antennas vertically above one another the loss is finite (S39)") {
    const TwoRay exact{.form = TwoRayForm::exact};
    for (const double rise : {0.1, 1.0, 50.0}) {
        const double above = loss_over_ground(1, 1 + rise, 0, 2450_MHz, exact);
        CHECK(std::isfinite(above));
        for (const double d : {1e-12, 1e-9, 1e-6}) {
            CHECK(near(loss_over_ground(1, 1 + rise, d, 2450_MHz, exact), above, 1e-9));
        }
    }
}

}  // namespace two_ray_test
