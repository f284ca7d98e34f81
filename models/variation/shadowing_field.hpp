// SPDX-License-Identifier: MIT
#pragma once

#include "models/variation/pair_waves.hpp"
#include "models/variation/shadowing.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <cstdint>

namespace rovernet {

/// Random field of shadowing over the positions a and b of both ends:
///
///   Z(a, b) = (G(a, b) + G(b, a)) / sqrt(2 (1 + e^(-2 |a - b| / d_cor))),
///   G(a, b) = sqrt(2 / N) sum over m of cos(k_m.a + q_m.b + phi_m),  N = 32,
///   |k| = sqrt((1 - u Z_K)^-2 - 1) / d_cor,  Z_K = 1 - 1 / sqrt(1 + K^2 d_cor^2),  K d_cor = 50,
///
/// with u uniform in (0, 1) and uniform directions and phases. Z has mean 0 and variance 1 over the
/// seeds. Its correlation is e^(-D / d_cor), within 0.022, when one end moves by D. When both ends
/// move, the correlation is the product of the correlations of each move. (For a sum S(a) + S(b) of
/// a field over single positions the correlation would never fall below one half when one end
/// moves.) This holds for ends at least d_cor apart. For nearer ends the correlation is larger: for
/// |a - b| << D by sqrt(2 / (1 + e^(-2 D / d_cor))). Distances are horizontal.
///
/// Sources: M. Gudmundson, Correlation model for shadow fading in mobile radio systems, Electronics
/// Letters 27(23), 1991, for the correlation; |k| is the radial spectrum of e^(-D / d_cor) in the
/// plane, without wave numbers above K.
class ShadowingField {
  public:
    /// Creates the shadowing field of a run.
    ShadowingField(Meters decorrelation_distance, std::uint64_t seed, std::uint32_t replication);
    /// Value Z(a, b) of the field [-], limited to +-5; takes about 100 ns.
    double operator()(Vec3 a, Vec3 b) const;

  private:
    // Decorrelation distance d_cor [m].
    double decorrelation_;
    PairWaves waves_;
};

}  // namespace rovernet
