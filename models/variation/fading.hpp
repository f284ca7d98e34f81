// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <string_view>

// Fading: variation of a frame's level by constructive and destructive interference of reflections.
// In code:
//
//     Network network({.fading = {.model = FadingModel::rician, .k_factor = 6_dB}});

namespace rovernet {

/// Model of fading: distribution of a frame's power relative to its local mean.
///
/// - none: the power is the local mean
/// - rayleigh: many waves without line of sight; exponential distribution
/// - rician: a line of sight with K times the power of all other waves together
/// - nakagami: gamma distribution of shape m; m = 1 is rayleigh
enum class FadingModel { none, rayleigh, rician, nakagami };
/// Names of the values of [fading] model in scenario files.
template <>
struct EnumNames<FadingModel> {
    static constexpr std::array<std::string_view, 4> values = {"none", "rayleigh", "rician",
                                                               "nakagami"};
};

/// Coherence of fading. `frame`: an independent value for each frame at each receiver. `place`: a
/// function of the positions of both ends, so that equal positions give equal values at any time.
enum class Coherence { frame, place };
/// Names of the values of [fading] coherence in scenario files.
template <>
struct EnumNames<Coherence> {
    static constexpr std::array<std::string_view, 2> values = {"frame", "place"};
};

/// Settings of fading. The power g of a frame relative to its local mean has mean 1:
///
///   rayleigh  g = |z|^2                                      z complex normal, mean |z|^2 = 1
///   rician    g = |sqrt(K / (K + 1)) e^(j 2 pi d / lambda) + z / sqrt(K + 1)|^2
///   nakagami  g = F^-1(1 - e^(-|z|^2)) / m                   F: distribution function of gamma(m)
///             g = (x_1^2 + ... + x_2m^2) / m                 of places: x_i are the real and
///                                                            imaginary parts of several z
///
/// K is `k_factor`, d the distance of the antennas, lambda the wavelength. g is cut at its quantile
/// of 1 - 1e-6, which bounds the range: 11.4 dB for rayleigh.
///
/// Source: J. G. Proakis, Digital Communications, 4th ed., sections 2.1.4 and 14.1.
struct Fading {
    FadingModel model = FadingModel::none;
    Coherence coherence = Coherence::frame;
    /// Power ratio K of the line of sight to all other waves [dB], for rician.
    Db k_factor{6};
    /// Shape m [-] of nakagami, >= 0.5: a larger m means less fading.
    double m = 2;

    /// Parameters, which are the keys of [fading] in scenario files.
    static constexpr auto fields() {
        return describe(
            field("model", &Fading::model,
                  "distribution of the fading: none, rayleigh, rician or nakagami"),
            field("coherence", &Fading::coherence,
                  "frame: the fading is drawn for each frame at each receiver; place: the fading "
                  "depends on the places of both robots"),
            field("k_factor", &Fading::k_factor,
                  Range{.low = -100, .high = 30, .text = "from -100 dB to 30 dB"},
                  "for rician: power of the direct wave relative to the power of all other waves"),
            field("m", &Fading::m, Range{.low = 0.5, .high = 100, .text = "from 0.5 to 100"},
                  "for nakagami: shape parameter m; 1 is rayleigh. With coherence = \"place\", the "
                  "rate of level crossings agrees with theory only if 2 * m is a whole number"));
    }

    /// Quantile of the power g relative to its local mean [-]: g is below the quantile with
    /// probability p, 1e-9 <= p <= 1 - 1e-9. Not for the model `none`.
    double quantile(double p) const;
};

}  // namespace rovernet
