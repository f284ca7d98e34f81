// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// Kind of indoor site in ITU-R P.1238-11: it gives the coefficients of the equation.
enum class Site { office, corridor, industrial };
/// Words of `site` in files.
template <>
struct EnumNames<Site> {
    static constexpr std::array<std::string_view, 3> values = {"office", "corridor", "industrial"};
};

/// Line of sight between two antennas: whether it is clear of walls.
enum class LineOfSight {
    /// As the scene's walls say; clear on an open field.
    map,
    yes,
    no,
};
/// Words of `los` in files.
template <>
struct EnumNames<LineOfSight> {
    static constexpr std::array<std::string_view, 3> values = {"map", "yes", "no"};
};

/// Site-general path loss indoors [dB] after ITU-R P.1238-11, the median, held at its value at 1 m
/// below, never negative:
///
///   L(d) = 10 a log10 d + b + 10 g log10 f      (f in GHz, d in m)
///
/// a, b and g are those of the kind of site, with and without line of sight. Valid for d of 2 to 27
/// m (office; corridor 160 m, industrial 101 m), without line of sight from 4 m on, between
/// terminals on one floor.
///
/// Walls are inside the coefficients: what stands in the way, a wall or a ceiling, only decides
/// which row holds, so that the loss jumps where a wall comes between. The Recommendation's
/// deviation of 3 to 9 dB is left to shadowing.
///
/// In an office with line of sight, at 2450 MHz, `rovernet loss itu_site_general` prints
///
///   1 m   42.52 dB
///   10 m  57.12 dB
///
/// Source: Recommendation ITU-R P.1238-11 (2021), equation 1 and table 2.
struct ItuSiteGeneral {
    static constexpr std::string_view name = "itu_site_general";

    /// Kind of site.
    Site site = Site::office;
    /// Line of sight: looked up in the map, or given for all links.
    LineOfSight los = LineOfSight::map;

    static constexpr auto fields() {
        return describe(
            field("site", &ItuSiteGeneral::site, "kind of site: office, corridor or industrial"),
            field("los", &ItuSiteGeneral::los,
                  "line of sight: map, as the scene's walls say; yes; or no"));
    }

    LossShape shape() const {
        return los == LineOfSight::map ? LossShape::unknown : LossShape::by_distance;
    }

    /// Checks a frequency that some radio sends at.
    /// @throws std::invalid_argument outside of the site's range, 0.3 or 0.625 to 70 or 83 GHz
    void check_frequency(Hertz f) const;

    /// Distance [m] beyond which the loss is more than `loss`, whatever stands in the way.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] [dB] for the i-th receiver.
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;
};

}  // namespace rovernet
