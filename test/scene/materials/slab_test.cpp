// SPDX-License-Identifier: MIT
#include "scene/materials/slab.hpp"

#include "sim/math.hpp"
#include "test/models/vectors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace slab_test {
using namespace rovernet;
using test::near;

namespace {

std::optional<ItuMaterial> material_named(const std::string& name) {
    for (std::size_t i = 0; i < EnumNames<ItuMaterial>::values.size(); ++i)
        if (EnumNames<ItuMaterial>::values[i] == name) return static_cast<ItuMaterial>(i);
    return std::nullopt;  // of an older edition
}

double loss_db(math::Complex field, double decay = 0) {
    return -10 * math::log10(std::norm(field)) + 8.685889638065037 * decay;
}

}  // namespace

TEST_CASE(
    "slab: losses, and amplitude and phase of the transmitted field, equal the test vectors") {
    const test::Vectors vectors("slab_transmission.csv");
    int compared = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        const double f = vectors.number(i, "f_GHz") * 1e9;
        const double thick = vectors.number(i, "thickness_m");
        const double cosine =
            math::sincos(vectors.number(i, "theta_deg") * std::numbers::pi / 180).cos;
        const auto material = material_named(vectors.text(i, "material"));
        if (!material) continue;
        const Slab slab(*material, {f});
        const SlabFields fields = slab.fields(thick, cosine);
        CAPTURE(i);
        CHECK(near(loss_db(fields.transmitted, fields.decay), vectors.number(i, "TE_trans_loss_dB"),
                   1e-6));
        CHECK(near(loss_db(fields.reflected), vectors.number(i, "TE_refl_loss_dB"), 1e-6));
        const math::Complex expected{vectors.number(i, "T_TE_re"), vectors.number(i, "T_TE_im")};
        if (std::norm(expected) < 1e-30) continue;  // metal
        // The table's field is behind the slab over that before it: the way through air is in it.
        const double k = 2 * std::numbers::pi * f / speed_of_light;
        const math::Complex found = math::exp(math::Complex{-fields.decay, 0}) *
                                    fields.transmitted * math::phasor(-k * thick * cosine);
        CHECK(std::norm(found - expected) < 1e-20);
        ++compared;
    }
    CHECK(compared > 150);
}

TEST_CASE("slab: a slab of thickness 0 has no effect, and no slab increases the power") {
    for (const auto material : {ItuMaterial::concrete, ItuMaterial::glass, ItuMaterial::metal}) {
        const Slab slab(material, 2450_MHz);
        for (double cosine = 0.01; cosine <= 1; cosine += 0.01) {
            const SlabFields none = slab.fields(0, cosine);
            CHECK(std::norm(none.transmitted - 1.0) < 1e-24);
            CHECK(std::norm(none.reflected) < 1e-24);
            for (const double thick : {1e-4, 0.01, 0.1, 3.0}) {
                const SlabFields f = slab.fields(thick, cosine);
                CHECK(std::norm(f.transmitted) * std::exp(-2 * f.decay) + std::norm(f.reflected) <=
                      1 + 1e-9);
            }
        }
    }
}

}  // namespace slab_test
