// SPDX-License-Identifier: MIT
#pragma once

#include "sim/fields.hpp"
#include "sim/units.hpp"

#include <array>
#include <string_view>

// Shadowing: random part of the path loss, for obstacles that the propagation model does not
// contain. In code:
//
//     Network network({.propagation = Friis{},
//                      .shadowing = {.model = ShadowingModel::field, .sigma = 6_dB}});

namespace rovernet {

/// Model of shadowing.
///
/// - none: no shadowing
/// - link: a draw for each pair of robots, independent of their positions
/// - field: a random field over the positions of both ends
enum class ShadowingModel { none, link, field };
/// Names of the values of [shadowing] model in scenario files.
template <>
struct EnumNames<ShadowingModel> {
    static constexpr std::array<std::string_view, 3> values = {"none", "link", "field"};
};

/// Log-normal shadowing [dB]: L = max(0, L_model + X), with X normal of mean 0 and standard
/// deviation sigma, cut at 5 sigma.
///
/// X is equal in both directions, at all times and for any number of samples: X is a function of
/// seed, replication, and the unordered pair of robots (`link`) or of positions (`field`). Shadowed
/// adds X to a propagation model. The cut (5.7e-7 of draws) bounds the range.
struct Shadowing {
    /// Number of standard deviations at which the shadowing X is cut off [-].
    static constexpr double cut_sigmas = 5;

    ShadowingModel model = ShadowingModel::none;
    /// Standard deviation of the shadowing X [dB], >= 0.
    Db sigma{5};
    /// Decorrelation distance d_cor [m], >= 1 mm: the correlation of `field` falls to 1 / e when
    /// one end moves by this distance. 3GPP TR 38.901, table 7.5-6, has 10 m and 6 m for offices
    /// with and without line of sight.
    Meters decorrelation_distance{10};

    /// Parameters, which are the keys of [shadowing] in scenario files.
    static constexpr auto fields() {
        return describe(
            field("model", &Shadowing::model,
                  "none: no shadowing; link: one random value for each pair of robots; field: a "
                  "random value that depends on the places of both robots"),
            field("sigma", &Shadowing::sigma, non_negative, "standard deviation of the shadowing"),
            field("decorrelation_distance", &Shadowing::decorrelation_distance,
                  Range{.low = 1e-3, .text = ">= 1 mm"},
                  "for field: if one end of a link moves by this distance, the correlation with "
                  "its previous shadowing falls to 1 / e"));
    }
};

}  // namespace rovernet
