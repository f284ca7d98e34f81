// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Kind of indoor site in ITU-R P.1238-11, which determines the coefficients.
enum class Site { office, corridor, industrial };
/// Names of the values of `site` in scenario files.
template <>
struct EnumNames<Site> {
    static constexpr std::array<std::string_view, 3> values = {"office", "corridor", "industrial"};
};

/// Setting of the line of sight between antennas: determined by the map, always clear (yes), or
/// always obstructed (no).
enum class LineOfSight {
    /// Determined by the scene's walls; always clear on an open field.
    map,
    yes,
    no,
};
/// Names of the values of `los` in scenario files.
template <>
struct EnumNames<LineOfSight> {
    static constexpr std::array<std::string_view, 3> values = {"map", "yes", "no"};
};

/// Site-general indoor path loss [dB] by ITU-R P.1238-11, the median. The loss is never negative.
/// Below 1 m it is fixed at its value at 1 m:
///
///   L(d) = 10 a log10 d + b + 10 g log10 f      (f in GHz, d in m)
///
/// a, b and g depend on the kind of site and on the line of sight. Valid for d from 2 to 27 m
/// (office; corridor 160 m, industrial 101 m), without line of sight from 4 m on, between terminals
/// on one floor.
///
/// The coefficients include walls: a wall or a ceiling in the path only selects the row of the
/// table, so the loss jumps when a wall obstructs the line of sight. The Recommendation's standard
/// deviation of 3 to 9 dB is not included: use shadowing.
///
/// In an office with line of sight, at 2450 MHz, `rovernet loss itu_site_general` prints
///
///   1 m   42.52 dB
///   10 m  57.12 dB
///
/// Source: Recommendation ITU-R P.1238-11 (2021), equation 1 and table 2.
struct ItuSiteGeneral {
    static constexpr std::string_view name = "itu_site_general";
    static constexpr bool is_indoor = true;

    /// Kind of indoor site, which selects the coefficients.
    Site site = Site::office;
    /// Line of sight: determined by the scene's walls for each link, or fixed for all links.
    LineOfSight los = LineOfSight::map;

    static constexpr auto fields() {
        return describe(
            field("site", &ItuSiteGeneral::site, "kind of site: office, corridor or industrial"),
            field("los", &ItuSiteGeneral::los,
                  "whether there is a line of sight between the antennas: map (the walls of the "
                  "map decide), yes or no"));
    }

    LossShape shape() const {
        return los == LineOfSight::map ? LossShape::unknown : LossShape::by_distance;
    }

    /// Checks a radio's frequency.
    /// @throws std::invalid_argument outside the site's range, 0.3 or 0.625 GHz to 70 or 83 GHz
    void check_frequency(Hertz f) const;

    /// Distance [m] beyond which the loss is more than `loss`, with or without line of sight.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] with the loss [dB] to receiver i.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;
};

}  // namespace rovernet
