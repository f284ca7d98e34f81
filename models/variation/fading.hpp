// SPDX-License-Identifier: MIT
#pragma once

#include "models/variation/gamma.hpp"
#include "models/variation/pair_waves.hpp"
#include "sim/fields.hpp"
#include "sim/geometry.hpp"
#include "sim/random.hpp"
#include "sim/units.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

// Fading: what reflections that add up or cancel do to the level of a frame. In code:
//
//     Network network({.fading = {.model = FadingModel::rician, .k_factor = 6_dB}});

namespace rovernet {

/// Model of fading: the distribution of a frame's power over its local mean.
///
/// - none: the power is the local mean
/// - rayleigh: many waves and no line of sight; exponential
/// - rician: a line of sight with the power K of all other waves
/// - nakagami: gamma of shape m; m = 1 is rayleigh
enum class FadingModel { none, rayleigh, rician, nakagami };
/// Words of [fading] model in files.
template <>
struct EnumNames<FadingModel> {
    static constexpr std::array<std::string_view, 4> values = {"none", "rayleigh", "rician",
                                                               "nakagami"};
};

/// What has one fade: each frame at each receiver has its own (`frame`), or a fade is a function of
/// the places of both ends (`place`), so that a robot that comes back finds the same.
enum class Coherence { frame, place };
/// Words of [fading] coherence in files.
template <>
struct EnumNames<Coherence> {
    static constexpr std::array<std::string_view, 2> values = {"frame", "place"};
};

/// Settings of fading. The power g of a frame over its local mean has the mean 1:
///
///   rayleigh  g = |z|^2                                      z complex normal, mean |z|^2 = 1
///   rician    g = |sqrt(K / (K + 1)) e^(j 2 pi d / lambda) + z / sqrt(K + 1)|^2
///   nakagami  g = F^-1(1 - e^(-|z|^2)) / m                   F: distribution function of gamma(m)
///             g = (x_1^2 + ... + x_2m^2) / m                 of places: x_i are the real and
///                                                            imaginary parts of several z
///
/// It is cut at its quantile of 1 - 1e-6, which bounds the range: 11.4 dB for rayleigh.
///
/// Source: J. G. Proakis, Digital Communications, 4th ed., sections 2.1.4 and 14.1.
struct Fading {
    FadingModel model = FadingModel::none;
    Coherence coherence = Coherence::frame;
    /// Power K of the line of sight over that of all other waves [dB], of rician.
    Db k_factor{6};
    /// Shape m [-] of nakagami, >= 0.5: the larger, the less it fades.
    double m = 2;

    /// Keys of [fading].
    static constexpr auto fields() {
        return describe(
            field("model", &Fading::model, "none, rayleigh, rician or nakagami"),
            field("coherence", &Fading::coherence,
                  "frame: each frame has its fade at each receiver; place: the places have it"),
            field("k_factor", &Fading::k_factor,
                  Range{.low = -100, .high = 30, .text = "from -100 dB to 30 dB"},
                  "of rician: the line of sight over all other waves"),
            field("m", &Fading::m, Range{.low = 0.5, .high = 100, .text = "from 0.5 to 100"},
                  "of nakagami: shape; 1 is rayleigh. Of places, levels are crossed as often as in "
                  "theory if 2 m is whole"));
    }

    /// Quantile of g [-]: g is below it with probability p, 1e-9 <= p <= 1 - 1e-9. The model is not
    /// `none`.
    double quantile(double p) const;
};

/// Fades of a run: the gain g of each frame at each receiver, the same for everybody who asks.
///
/// With coherence `frame` z is a draw of the frame and the receiver. With `place` it is a field
/// over the places a and b of both ends,
///
///   z(a, b) = (W(a, b) + W(b, a)) / sqrt(2 N (1 + J0(2 pi |a - b| / lambda)^2)),
///   W(a, b) = sum over m of e^(j (2 pi (u_m.a + v_m.b) / lambda + phi_m)),  |u_m| = |v_m| = 1,
///
/// with N = 32 waves of uniform directions and phases: the same in both directions, and the
/// autocorrelation of z as one end moves by D is J0(2 pi D / lambda), as by R. H. Clarke, Bell
/// System Technical Journal 47(6), 1968. Distances are horizontal. There is no time step: a robot
/// at rest has one fade for each place of its peer.
///
/// A nakagami of places is made of ceil(m) such fields and costs as much as they do. If 2 m is
/// whole, it crosses levels as often as theory says (M. D. Yacoub, J. E. V. Bautista, L. Guedes,
/// IEEE Trans. Vehicular Technology 48(3), 1999). The power of any other m is that of the nearest
/// such one, bent to its own distribution: -15 dB is crossed 9 % too seldom for m = 1.8, and 23 %
/// too often for m = 1.2.
class Fades {
  public:
    /// @param settings  not of the model `none`
    /// @throws std::invalid_argument if one is out of its range
    Fades(const Fading& settings, std::uint64_t seed, std::uint32_t replication);

    /// Frame at a receiver.
    struct Frame {
        /// Key of the frame, and of the receiver.
        std::uint64_t key, receiver;
        /// Places of both antennas [m].
        Vec3 from, to;
        /// Carrier frequency [Hz].
        Hertz frequency;
    };
    /// Gain 10 log10 g [dB], from -200 dB to most().
    Db gain(const Frame& frame) const;
    /// Largest gain [dB].
    Db most() const { return most_; }

  private:
    // Turns of a wave between the places, and size of a field's amplitude there.
    struct Scale {
        double per_metre, size;
    };
    Scale scale(const Frame& frame) const;
    PairWaves::Value scattered(const Frame& frame) const;
    double nakagami_of_places(const Frame& frame) const;
    double power(const Frame& frame) const;

    Fading settings_;
    PairDraws draws_;
    // Fields, if places have the fades: one, or several whose powers are added.
    std::vector<PairWaves> fields_;
    // Real fields in fields_ whose squares are added, of a nakagami of places.
    double parts_ = 2;
    // Gamma variates, of a nakagami that is not the sum of fields alone.
    std::optional<GammaTable> gamma_;
    // Amplitudes of the line of sight and of the rest [-].
    double direct_ = 0, scattered_ = 1;
    Db most_{};
};

}  // namespace rovernet
