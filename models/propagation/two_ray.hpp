// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Form of the TwoRay model, which selects its equation.
enum class TwoRayForm {
    /// Simplified equation, as in ns-2: free space, then d^4.
    ns2,
    /// Sum of the two rays, with its peaks and nulls.
    exact,
};
/// Names of the values of `form` in scenario files.
template <>
struct EnumNames<TwoRayForm> {
    static constexpr std::array<std::string_view, 2> values = {"ns2", "exact"};
};

/// Polarization: direction of the electric field relative to the ground.
enum class Polarization { vertical, horizontal };
/// Names of the values of `polarization` in scenario files.
template <>
struct EnumNames<Polarization> {
    static constexpr std::array<std::string_view, 2> values = {"vertical", "horizontal"};
};

/// Two-ray ground reflection loss [dB], never negative.
///
/// Distances: d1 between the antennas, d2 the length of the path reflected by the ground; ht and hr
/// are the heights of the antennas: their z above a flat ground at z = 0. An antenna below
/// `lowest_antenna`, or below the ground, counts as `lowest_antenna` high, because the loss would
/// be infinite at height 0.
///
/// Form "ns2":   L = free space(d1) + max(0, 20 log10(d1 / dc)),   dc = 4 pi ht hr / lambda: beyond
/// the crossover distance dc this is d1^4 / (ht hr)^2, independent of frequency. The form neglects
/// the peaks and nulls before the crossover (the last null is 39 dB deep for 1.5 m at 2.4 GHz).
/// Source: T. S. Rappaport, Wireless Communications, 2nd ed., section 4.6, with the crossover of
/// the ns-2 manual, section 18.2.
///
/// Form "exact": L = free space(d1) - 20 log10 |1 + G (d1 / d2) exp(-j k (d2 - d1))|,
///   d2 - d1 = 4 ht hr / (d1 + d2),   k = 2 pi / lambda,   sin t = (ht + hr) / d2,
///   G = (sin t - z) / (sin t + z) for horizontal polarization,
///   G = (e sin t - z) / (e sin t + z) for vertical,   z = sqrt(e - cos^2 t),
/// with the reflection coefficient G of the ground, the angle t between reflected path and ground,
/// and the relative permittivity e of a lossless ground. Source: Rappaport, section 4.6 and
/// equations 4.24 and 4.25. The loss is not monotone: it falls to up to 6 dB below free space, and
/// rises without bound in a null.
///
/// For antennas 1 m high at 2450 MHz `rovernet loss two_ray` prints, without and with form=exact:
///
///   10 m      60.23 dB    59.48 dB
///   1000 m   120.00 dB   119.97 dB
///
/// Valid over open, flat ground, for heights of at least a wavelength. Walls and obstacles are
/// neglected.
struct TwoRay {
    static constexpr std::string_view name = "two_ray";

    /// Smallest antenna height in the equations [m], > 0; lower antennas count as this high.
    Meters lowest_antenna{0.1};
    /// Form of the model: equation of the loss.
    TwoRayForm form = TwoRayForm::ns2;
    /// Polarization, for form "exact".
    Polarization polarization = Polarization::vertical;
    /// Relative permittivity e of the ground [-], >= 1; for form "exact".
    double ground_permittivity = 15;

    static constexpr auto fields() {
        return describe(
            field("lowest_antenna", &TwoRay::lowest_antenna, positive,
                  "smallest antenna height above the ground (z = 0) in the equations: the height "
                  "of a lower antenna is replaced by this value"),
            field("form", &TwoRay::form,
                  "ns2: as in free space up to the crossover distance, then proportional to the "
                  "4th power of the distance; exact: the sum of the two rays"),
            field("polarization", &TwoRay::polarization,
                  "for form exact: polarization of the antennas, vertical or horizontal"),
            field("ground_permittivity", &TwoRay::ground_permittivity,
                  Range{.low = 1, .text = ">= 1"},
                  "for form exact: relative permittivity of the ground, from 3 (very dry) to 30 "
                  "(wet)"));
    }

    /// Forms of the model from the cheapest to the most detailed one, for `rovernet advise`.
    static std::array<TwoRay, 2> forms() {
        return {{{.form = TwoRayForm::ns2}, {.form = TwoRayForm::exact}}};
    }

    LossShape shape() const {
        return form == TwoRayForm::exact ? LossShape::unknown : LossShape::by_heights;
    }

    /// Upper bound of the range [m], if no antenna is higher than h = `highest` [m]. Form "ns2":
    /// the loss is at least that of free space, and at least 40 log10(d / h), the loss of two
    /// antennas of height h beyond their crossover. Form "exact": two fields in phase have twice
    /// the amplitude of free space (6.02 dB); for d1 >= 1 m that amplitude is also at most A / d1
    /// times free space, with
    ///   A = 2 h^2 + 2 k h^2 + 4 h g / sqrt(e - 1),   g = 1 (horizontal) or e (vertical),
    /// the sum of the bounds of 1 - d1 / d2, of the phase and of 1 + G, so that L grows with 40
    /// log10 d1.
    Meters reach(Db loss, Hertz f, Meters highest) const;
    /// Fills out_db[i] with the loss [dB] to receiver i.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;

  private:
    // Losses of form "exact". The function height() returns the height [m] of an antenna at z [m]
    // in the equations, at least lowest_antenna.
    void exact_loss(const LinkBatch& links, std::span<double> out_db) const;
    double height(double z) const { return z > lowest_antenna.value ? z : lowest_antenna.value; }
};

}  // namespace rovernet
