// SPDX-License-Identifier: MIT
#pragma once

#include "models/variation/pair_waves.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <string_view>

// Shadowing: what a propagation model does not know of the obstacles between two places, as a
// random part of the loss. In code:
//
//     Network network({.propagation = Friis{},
//                      .shadowing = {.model = ShadowingModel::field, .sigma = 6_dB}});

namespace rovernet {

/// Model of shadowing.
///
/// - none: there is none
/// - link: a draw of each pair of robots, wherever they are
/// - field: a random field over the places of both ends
enum class ShadowingModel { none, link, field };
/// Words of [shadowing] model in files.
template <>
struct EnumNames<ShadowingModel> {
    static constexpr std::array<std::string_view, 3> values = {"none", "link", "field"};
};

/// Log-normal shadowing [dB]: L = max(0, L_model + X), with X normal of mean 0 and standard
/// deviation sigma, cut at 5 sigma.
///
/// X is the same in both directions, and at every time and for every number of looks: a function of
/// seed, replication, and the unordered pair of robots (`link`) or of places (`field`). Shadowed
/// adds it to a propagation model. The cut (5.7e-7 of draws) bounds the range.
struct Shadowing {
    /// Standard deviations at which X is cut [-].
    static constexpr double cut_sigmas = 5;

    ShadowingModel model = ShadowingModel::none;
    /// Standard deviation of X [dB], >= 0.
    Db sigma{5};
    /// Distance d_cor [m], >= 1 mm, over which the correlation of `field` falls to 1 / e as one end
    /// moves. 3GPP TR 38.901, table 7.5-6, has 10 m and 6 m for offices with and without line of
    /// sight.
    Meters decorrelation_distance{10};

    /// Keys of [shadowing].
    static constexpr auto fields() {
        return describe(
            field("model", &Shadowing::model,
                  "none; link: a draw of each pair of robots; field: of both places"),
            field("sigma", &Shadowing::sigma, non_negative, "standard deviation of the shadowing"),
            field("decorrelation_distance", &Shadowing::decorrelation_distance,
                  Range{.low = 1e-3, .text = ">= 1 mm"},
                  "of field: the correlation falls to 1 / e as one end moves so far"));
    }
};

/// Random field of shadowing over the places a and b of both ends:
///
///   Z(a, b) = (G(a, b) + G(b, a)) / sqrt(2 (1 + e^(-2 |a - b| / d_cor))),
///   G(a, b) = sqrt(2 / N) sum over m of cos(k_m.a + q_m.b + phi_m),  N = 32,
///   |k| = sqrt((1 - u Z_K)^-2 - 1) / d_cor,  Z_K = 1 - 1 / sqrt(1 + K^2 d_cor^2),  K d_cor = 50,
///
/// with u uniform in (0, 1) and directions and phases uniform. Z has mean 0 and variance 1 over the
/// seeds. Its correlation is e^(-D / d_cor), within 0.022, as one end moves by D, and the product
/// of both ends' as both move. (A sum S(a) + S(b) of a field of places would keep one half however
/// far one end moves.) That holds for ends at least d_cor apart; nearer ones change places, and are
/// more alike: for |a - b| << D by sqrt(2 / (1 + e^(-2 D / d_cor))). Distances are horizontal.
///
/// Sources: M. Gudmundson, Correlation model for shadow fading in mobile radio systems, Electronics
/// Letters 27(23), 1991, for the correlation; |k| is the radial spectrum of e^(-D / d_cor) in the
/// plane, without wave numbers above K.
class ShadowingField {
  public:
    /// Field of a run.
    ShadowingField(Meters decorrelation_distance, std::uint64_t seed, std::uint32_t replication);
    /// Z(a, b) [-], cut at +-5; about 100 ns.
    double operator()(Vec3 a, Vec3 b) const;

  private:
    // d_cor [m].
    double decorrelation_;
    PairWaves waves_;
};

}  // namespace rovernet
