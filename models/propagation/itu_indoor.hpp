// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

#include <optional>

namespace rovernet {

/// Kind of building in ITU-R P.1238's tables.
enum class Environment { residential, office, commercial };

/// Names of the values of `environment` in scenario files.
template <>
struct EnumNames<Environment> {
    static constexpr std::array<std::string_view, 3> values = {"residential", "office",
                                                               "commercial"};
};

/// Indoor path loss [dB] by ITU-R P.1238; below 1 m the loss is fixed at its value at 1 m:
///
///   L(d) = 20 log10 f + N log10 d + Lf(n) - 28      (f in MHz, d in m, n floors crossed)
///
/// N is `coefficient`, or the table value for `environment` at the nearest frequency (by ratio, at
/// most 1.5). The floor loss Lf is a table value in the same way, with Lf(0) = 0; without an
/// environment there is no floor loss, as in the 2007 thesis (docs/formats/worlds.md). For more
/// floors than the table has, the value of its last floor is used. N includes the walls: do not add
/// them. In a scene of several storeys, n counts the ceilings whose material has no loss. The
/// losses of other ceilings are added, unless `floors` is given or there is no environment.
///
/// Site-general, from 900 MHz to 100 GHz: a median over buildings with a standard deviation of 8-12
/// dB, not a prediction for a single building. With N = 30 at 2450 MHz `rovernet loss itu_indoor`
/// prints
///
///   1 m   39.78 dB
///   10 m  69.78 dB
///
/// Source: Recommendation ITU-R P.1238-2 (2001), tables 2 and 3, with the 2.4 GHz rows of later
/// editions.
struct ItuIndoor {
    static constexpr std::string_view name = "itu_indoor";
    static constexpr bool is_indoor = true;

    /// Distance power loss coefficient N [-], > 0. If not given: by `environment`, or else 30.
    std::optional<double> coefficient = std::nullopt;
    /// Kind of building. It determines the floor loss and, unless `coefficient` is given, the
    /// distance power loss coefficient N.
    std::optional<Environment> environment = std::nullopt;
    /// Number of floors n between the antennas [-]; counted from antenna heights if not given.
    std::optional<int> floors = std::nullopt;

    static constexpr auto fields() {
        return describe(field("coefficient", &ItuIndoor::coefficient, positive,
                              "N, distance power loss coefficient; if not given, the coefficient "
                              "of the environment, or 30 without an environment")
                            .linear(30),
                        field("environment", &ItuIndoor::environment,
                              "kind of building; determines the floor loss and, if no coefficient "
                              "is given, also N"),
                        field("floors", &ItuIndoor::floors, non_negative,
                              "number of floors between the antennas; if not given, this number "
                              "follows from the heights of the antennas"));
    }

    /// Shape of the loss: by_heights if floors are counted and have a loss.
    LossShape shape() const {
        return floors || !environment ? LossShape::by_distance : LossShape::by_heights;
    }

    /// Checks a radio's frequency.
    /// @throws std::invalid_argument if the tables have no row near the frequency, or no loss of
    ///         `floors` floors
    void check_frequency(Hertz f) const;

    /// Distance [m] beyond which the loss is more than `loss`, for any number of floors.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] with the loss [dB] to receiver i; never negative.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;
};

/// Path loss [dB] by the formula of ITU-R P.1238, with given N and floor loss Lf [dB]; distances
/// below 1 m count as 1 m. Raytrace2007 uses itu_indoor_db() for its loss without walls.
double itu_indoor_db(double d, Hertz f, double N, double Lf);

/// Distance [m] at which itu_indoor_db() without floors is `loss`; 0 if the loss is always larger.
Meters itu_indoor_reach(Db loss, Hertz f, double N);

}  // namespace rovernet
