// SPDX-License-Identifier: MIT
#pragma once

#include "sim/geometry.hpp"

#include <array>
#include <cmath>
#include <cstddef>

// Random fields over the positions of both ends of a link, as sums of plane waves. A field has a
// value for each pair of positions, without a table, a grid or a state. Shadowing and fading use
// such fields.

namespace rovernet {

/// Cosine cos(2 pi x) for x [turns], |x| < 2^51; error below 1e-11, exactly even in x. The function
/// has no branch, so that a loop of calls can be vectorised.
inline double cos_of_turns(double x) {
    // The series of sin(2 pi y) for |y| <= 1/4, in y^2: (-1)^k (2 pi)^(2 k + 1) / (2 k + 1)!.
    constexpr double c0 = 6.283185307179586477, c1 = -41.341702240399760234,
                     c2 = 81.605249276075054203, c3 = -76.705859753061385841,
                     c4 = 42.058693944897653144, c5 = -15.094642576822990391,
                     c6 = 3.8199525848482821277, c7 = -0.71812230177850063164;
    constexpr double round = 0x1.8p52;
    const double y = 0.25 - std::abs(x - ((x + round) - round));
    const double z = y * y;
    return y * (c0 + z * (c1 + z * (c2 + z * (c3 + z * (c4 + z * (c5 + z * (c6 + z * c7)))))));
}

/// Sum of plane waves over the positions a and b of a link's ends, exactly the same in both
/// directions:
///
///   S(a, b) = sum over m of e^(j (k_m.a + q_m.b + phi_m)) + e^(j (k_m.b + q_m.a + phi_m))
///           = sum over m of 2 e^(j (s_m.(a + b) + phi_m)) cos(d_m.(a - b)),
///   s_m = (k_m + q_m) / 2,  d_m = (k_m - q_m) / 2.
///
/// The waves are horizontal: heights have no effect.
class PairWaves {
  public:
    /// Number of plane waves in the sum.
    static constexpr std::size_t count = 32;

    /// Plane wave: wave vectors (kx, ky) at one end and (qx, qy) at the other end [turns/m, or
    /// turns per unit of `scale`], and phase [turns].
    struct Wave {
        double kx, ky, qx, qy, phase;
    };
    /// Complex value of a sum [-].
    struct Value {
        double re, im;
    };

    /// @param wave_of  wave_of(m): plane wave number m, from 0
    template <class WaveOf>
    explicit PairWaves(WaveOf wave_of) {
        for (std::size_t m = 0; m < count; ++m) {
            const Wave w = wave_of(m);
            sum_x_[m] = (w.kx + w.qx) / 2;
            sum_y_[m] = (w.ky + w.qy) / 2;
            difference_x_[m] = (w.kx - w.qx) / 2;
            difference_y_[m] = (w.ky - w.qy) / 2;
            phase_[m] = w.phase;
        }
    }

    /// Real part [-] of the sum S(a, b) of plane waves, for the positions a and b of a link's ends.
    double real(Vec3 a, Vec3 b) const {
        const Vec3 sum = a + b, apart = a - b;
        std::array<double, count> terms;
        for (std::size_t m = 0; m < count; ++m) {
            terms[m] = cos_of_turns(sum_phase(m, sum)) * envelope(m, apart);
        }
        return 2 * total(terms);
    }
    /// Complex value [-] of the sum S(scale a, scale b) of plane waves, for the positions a and b
    /// of a link's ends.
    /// @param scale  factor by which both positions are multiplied
    Value complex(Vec3 a, Vec3 b, double scale) const {
        const Vec3 sum = scale * (a + b), apart = scale * (a - b);
        std::array<double, count> re, im;
        for (std::size_t m = 0; m < count; ++m) {
            const double turns = sum_phase(m, sum), size = envelope(m, apart);
            re[m] = cos_of_turns(turns) * size;
            im[m] = cos_of_turns(turns - 0.25) * size;
        }
        return {2 * total(re), 2 * total(im)};
    }

  private:
    using Terms = std::array<double, count>;

    double sum_phase(std::size_t m, Vec3 sum) const {
        return sum_x_[m] * sum.x + sum_y_[m] * sum.y + phase_[m];
    }
    double envelope(std::size_t m, Vec3 apart) const {
        return cos_of_turns(difference_x_[m] * apart.x + difference_y_[m] * apart.y);
    }
    // Sum of the terms in a fixed order, as four partial sums.
    static double total(const Terms& terms) {
        std::array<double, 4> sums{};
        for (std::size_t m = 0; m < count; m += 4) {
            for (std::size_t i = 0; i < 4; ++i) sums[i] += terms[m + i];
        }
        return (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }

    Terms sum_x_, sum_y_, difference_x_, difference_y_, phase_;
};

}  // namespace rovernet
