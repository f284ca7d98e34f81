// SPDX-License-Identifier: MIT
#pragma once

#include "models/variation/fading.hpp"
#include "models/variation/gamma.hpp"
#include "models/variation/pair_waves.hpp"
#include "sim/geometry.hpp"
#include "sim/random.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace rovernet {

/// Fading of a run: the gain g of each frame at each receiver (received power over its local mean).
/// Repeated calls for a frame and a receiver give equal gains.
///
/// The gain g follows from a complex normal random number z, see Fading. With coherence `frame`, z
/// is a draw for the frame and the receiver. With `place`, z is a random field over the positions a
/// and b of both ends,
///
///   z(a, b) = (W(a, b) + W(b, a)) / sqrt(2 N (1 + J0(2 pi |a - b| / lambda)^2)),
///   W(a, b) = sum over m of e^(j (2 pi (u_m.a + v_m.b) / lambda + phi_m)),  |u_m| = |v_m| = 1,
///
/// with the wavelength lambda, the Bessel function J0, and N = 32 plane waves of uniform random
/// directions u_m and v_m and phases phi_m. z is the same in both directions; the autocorrelation
/// of z, when one end moves by D, is J0(2 pi D / lambda), as in R. H. Clarke, Bell System Technical
/// Journal 47(6), 1968. Distances are horizontal. There is no time step: between robots at rest the
/// fading is constant.
///
/// With `place`, nakagami consists of ceil(m) such fields, and takes that many times as long. If 2
/// m is an integer, its level crossing rate is that of theory (M. D. Yacoub, J. E. V. Bautista, L.
/// Guedes, IEEE Trans. Vehicular Technology 48(3), 1999). For any other m, the power of the nearest
/// such m is transformed to the distribution of m: -15 dB is crossed 9 % too seldom for m = 1.8,
/// and 23 % too often for m = 1.2.
class Fades {
  public:
    /// @param settings  settings with a model other than `none`
    /// @throws std::invalid_argument if a setting is out of its range
    Fades(const Fading& settings, std::uint64_t seed, std::uint32_t replication);

    /// Frame at a receiver: keys and positions on which its fading depends.
    struct Frame {
        /// Key of the frame, and key of the receiver.
        std::uint64_t key, receiver;
        /// Positions of both antennas [m].
        Vec3 from, to;
        /// Carrier frequency [Hz].
        Hertz frequency;
    };
    /// Gain by fading [dB] of a frame at a receiver: its power over the local mean, from -200 dB to
    /// most().
    Db gain(const Frame& frame) const;
    /// Largest gain by fading [dB].
    Db most() const { return most_; }

  private:
    // Scale of a field of plane waves: wave number [turns/m], and factor of the amplitude [-].
    struct Scale {
        double per_metre, size;
    };
    Scale scale(const Frame& frame) const;
    PairWaves::Value scattered(const Frame& frame) const;
    double nakagami_of_places(const Frame& frame) const;
    double power(const Frame& frame) const;

    Fading settings_;
    PairDraws draws_;
    // Random fields for coherence `place`: one field, or several fields whose powers are added.
    std::vector<PairWaves> fields_;
    // Number of real-valued fields (real or imaginary parts) whose squares are added, for nakagami
    // with `place`.
    double parts_ = 2;
    // Table of gamma variates, for nakagami if the power is not only a sum of fields.
    std::optional<GammaTable> gamma_;
    // Amplitude of the line of sight, and amplitude of the sum of all other waves [-].
    double direct_ = 0, scattered_ = 1;
    Db most_{};
};

}  // namespace rovernet
