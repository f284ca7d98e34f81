// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

#include <optional>

namespace rovernet {

/// Kind of building in ITU-R P.1238's tables.
enum class Environment { residential, office, commercial };

/// Words of `environment` in files.
template <>
struct EnumNames<Environment> {
    static constexpr std::array<std::string_view, 3> values = {"residential", "office",
                                                               "commercial"};
};

/// Path loss indoors [dB] after ITU-R P.1238, for d >= 1 m, held at its value at 1 m below:
///
///   L(d) = 20 log10 f + N log10 d + Lf(n) - 28      (f in MHz, d in m, n floors between)
///
/// N comes from `coefficient`, or from the row of the table for `environment` that is nearest in
/// log frequency (at most a factor 1.5 away). Lf comes from the table likewise, and Lf(0) = 0; with
/// a bare coefficient there is no floor term, as in the 2007 thesis. Beyond the last tabulated
/// floor its value is held. Walls are inside N: add none. In a scene of several storeys n counts
/// the ceilings between whose material gives no loss; the others add theirs, unless `floors` is
/// given or there is no environment.
///
/// Site-general, from 900 MHz to 100 GHz: a median over buildings, sigma 8-12 dB, not a prediction
/// for one of them. With N = 30 at 2450 MHz `rovernet loss itu_indoor` prints
///
///   1 m   39.78 dB
///   10 m  69.78 dB
///
/// Source: Recommendation ITU-R P.1238-2 (2001), tables 2 and 3, with the 2.4 GHz rows of later
/// editions.
struct ItuIndoor {
    static constexpr std::string_view name = "itu_indoor";

    /// Distance power loss coefficient N [-], > 0; 30 if neither this nor an environment is given.
    std::optional<double> coefficient = std::nullopt;
    /// Kind of building: gives N (unless `coefficient` does) and the floor loss.
    std::optional<Environment> environment = std::nullopt;
    /// Floors n between the antennas [-]; counted from their heights if not given.
    std::optional<int> floors = std::nullopt;

    static constexpr auto fields() {
        return describe(
            field("coefficient", &ItuIndoor::coefficient, positive,
                  "N, distance power loss coefficient; 30 if no environment is given"),
            field("environment", &ItuIndoor::environment,
                  "kind of building: gives N (unless coefficient does) and the floor loss"),
            field("floors", &ItuIndoor::floors, non_negative,
                  "floors between the antennas; counted from their heights if not given"));
    }

    /// By heights if floors are counted and cost something.
    LossShape shape() const {
        return floors || !environment ? LossShape::by_distance : LossShape::by_heights;
    }

    /// Checks a frequency that some radio sends at.
    /// @throws std::invalid_argument if no row of the table is near enough, or has so many floors
    void check_frequency(Hertz f) const;

    /// Distance [m] beyond which the loss is more than `loss`, floors left out: with them it is
    /// nearer.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] [dB] for the i-th receiver; never negative.
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;
};

/// Loss [dB] by the classic formula, with a given N and floor loss Lf [dB]; d [m] is held at 1 m
/// below 1 m. Raytrace2007 takes it as its loss without walls.
double itu_indoor_db(double d, Hertz f, double N, double Lf);

/// Distance [m] at which itu_indoor_db without floors reaches `loss`; 0 if it always does.
Meters itu_indoor_reach(Db loss, Hertz f, double N);

}  // namespace rovernet
