// SPDX-License-Identifier: MIT
#include "scene/materials/p2040.hpp"

#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace p2040_test {
using namespace rovernet;
using test::Vectors;

namespace {

constexpr double pi = 3.14159265358979323846;

/// The material of that name; none for older editions' and for the ground.
std::optional<ItuMaterial> material_named(const std::string& name) {
    const auto& names = EnumNames<ItuMaterial>::values;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<ItuMaterial>(found - names.begin());
}

Hertz frequency(const Vectors& vectors, std::size_t row) {
    return {vectors.number(row, "f_GHz") * 1e9};
}

bool equal(double value, double expected, double relative) {
    return std::abs(value - expected) <= relative * std::abs(expected);
}

}  // namespace

TEST_CASE("p2040: permittivities equal the test vectors (table p2040_materials)") {
    constexpr double relative = 1e-9;  // a dozen digits of the vectors
    const Vectors vectors("p2040_materials.csv");
    std::size_t rows = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const auto material = material_named(vectors.text(i, "material"));
        if (!material) continue;
        CAPTURE(vectors.text(i, "material"));
        CAPTURE(vectors.text(i, "f_GHz"));
        const Permittivity eps = permittivity(*material, frequency(vectors, i));
        CHECK(equal(eps.real, vectors.number(i, "eps_r"), relative));
        CHECK(equal(eps.imaginary, vectors.number(i, "eps_imag"), relative));
        ++rows;
    }
    CHECK(rows == 4 * EnumNames<ItuMaterial>::values.size());
}

TEST_CASE("p2040: the loss per metre deep inside a material equals the test vectors") {
    const Vectors vectors("p2040_materials.csv");
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const auto material = material_named(vectors.text(i, "material"));
        if (!material) continue;
        CAPTURE(vectors.text(i, "material"));
        const double per_metre = vectors.number(i, "bulk_attenuation_dB/m");
        // Between slabs in which the wave that is reflected twice has lost 400 dB.
        const double thickness = 200 / per_metre;
        const Hertz f = frequency(vectors, i);
        const Db difference =
            slab_loss(*material, {2 * thickness}, f) - slab_loss(*material, {thickness}, f);
        CHECK(equal(difference.value, 200, 1e-9));
    }
}

TEST_CASE(
    "p2040: losses of slabs equal the test vectors at every angle (table slab_transmission)") {
    constexpr double tolerance = 1e-8;  // [dB], see the vectors' description
    const Vectors vectors("slab_transmission.csv");
    std::size_t rows = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const auto material = material_named(vectors.text(i, "material"));
        if (!material) continue;
        CAPTURE(vectors.text(i, "material"));
        CAPTURE(vectors.text(i, "thickness_m"));
        CAPTURE(vectors.text(i, "theta_deg"));
        const Meters thickness{vectors.number(i, "thickness_m")};
        const Hertz f = frequency(vectors, i);
        const double degrees = vectors.number(i, "theta_deg");
        const SlabLosses slab = slab_losses(*material, thickness, f, Radians{degrees * pi / 180});
        CHECK(test::near(slab.te_transmission.value, vectors.number(i, "TE_trans_loss_dB"),
                         tolerance));
        CHECK(test::near(slab.tm_transmission.value, vectors.number(i, "TM_trans_loss_dB"),
                         tolerance));
        CHECK(
            test::near(slab.te_reflection.value, vectors.number(i, "TE_refl_loss_dB"), tolerance));
        CHECK(
            test::near(slab.tm_reflection.value, vectors.number(i, "TM_refl_loss_dB"), tolerance));
        if (degrees == 0) CHECK(slab_loss(*material, thickness, f) == slab.te_transmission);
        ++rows;
    }
    CHECK(rows == 203);
}

TEST_CASE("p2040: a slab transmits and reflects together at most the power that it receives") {
    for (std::size_t i = 0; i < EnumNames<ItuMaterial>::values.size(); ++i) {
        for (const double degrees : {0.0, 20.0, 63.4, 80.0, 89.9}) {
            for (const double thickness : {1e-6, 0.001, 0.013, 0.2, 3.0}) {
                CAPTURE(i);
                CAPTURE(degrees);
                CAPTURE(thickness);
                const SlabLosses slab = slab_losses(static_cast<ItuMaterial>(i), {thickness},
                                                    2450_MHz, Radians{degrees * pi / 180});
                const auto share = [](Db loss) { return std::pow(10, -loss.value / 10); };
                for (const auto& [through, back] :
                     {std::pair{slab.te_transmission, slab.te_reflection},
                      std::pair{slab.tm_transmission, slab.tm_reflection}}) {
                    CHECK(std::isfinite(through.value));
                    CHECK(through.value > -1e-9);
                    CHECK(back.value > -1e-9);
                    CHECK(share(through) + share(back) < 1 + 1e-9);
                }
            }
        }
    }
}

TEST_CASE(
    "p2040: wall factors of real walls equal the test vectors (table wallfactor_equivalent)") {
    constexpr double relative = 1e-9;  // the vectors' last digits
    const Vectors vectors("wallfactor_equivalent.csv");
    REQUIRE(vectors.size() == 7);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        CAPTURE(vectors.text(i, "material"));
        const double thickness = vectors.number(i, "thickness_m");
        const auto material = material_named(vectors.text(i, "material"));
        REQUIRE(material.has_value());
        const double loss = slab_loss(*material, {thickness}, 2450_MHz).value;
        CHECK(equal(loss, vectors.number(i, "slab_loss_dB_2.45GHz_normal"), relative));
        // In dB per centimetre.
        CHECK(
            equal(loss / thickness / 100, vectors.number(i, "thesis_wallfactor_equiv"), relative));
    }
}

TEST_CASE("p2040: a slab of thickness 0 has no loss, and a slab of 1000 m has a finite loss") {
    constexpr double rounding = 1e-13;  // [dB]
    for (std::size_t i = 0; i < EnumNames<ItuMaterial>::values.size(); ++i) {
        const auto material = static_cast<ItuMaterial>(i);
        CAPTURE(i);
        CHECK(std::abs(slab_loss(material, {0}, 2450_MHz).value) <= rounding);
        CHECK(std::isfinite(slab_loss(material, 1000_m, 2450_MHz).value));
    }
}

TEST_CASE("p2040: along the face of a slab, at 90 degrees, losses are finite and large (S13)") {
    for (std::size_t i = 0; i < EnumNames<ItuMaterial>::values.size(); ++i) {
        const SlabLosses slab =
            slab_losses(static_cast<ItuMaterial>(i), 0.1_m, 2450_MHz, Radians{pi / 2});
        for (const Db through : {slab.te_transmission, slab.tm_transmission}) {
            CAPTURE(i);
            CHECK(std::isfinite(through.value));
            CHECK(through.value > 100);
        }
        CHECK(test::near(slab.te_reflection.value, 0, 1e-9));
    }
}

TEST_CASE(
    "p2040: a formula applies at the ends of its frequency range and continues beyond them (S44)") {
    const auto eps = [](double ghz) {
        return permittivity(ItuMaterial::concrete, Hertz{ghz * 1e9}).imaginary;
    };
    CHECK(test::near(eps(1), 17.975103584522344 * 0.0462, 1e-12));
    for (const double end : {1.0, 100.0}) {
        CHECK(test::near(eps(end * (1 - 1e-9)), eps(end), 1e-8));
        CHECK(test::near(eps(end * (1 + 1e-9)), eps(end), 1e-8));
    }
}

}  // namespace p2040_test
