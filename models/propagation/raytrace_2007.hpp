// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

namespace rovernet {

/// The 2007 thesis's ray rule [dB], for d >= 1 m, held at its value at 1 m below:
///   L = 20 log10 f + N log10 d - 28 + 100 w l      (f in MHz, d in m, l metres of wall)
///
/// One straight ray: no reflection, no diffraction. A link that is lost without its walls is given
/// up before any wall is looked for, and a ray is given up once its walls have spent the budget.
/// The wall factor w is in dB per centimetre; real walls have 0.15 (wood) to 0.9 (chipboard), so
/// that the values of old world files (6 to 100) suit walls drawn a few pixels thin only. N holds
/// the walls of a usual building already: take N = 20 when the map shows them all. A wall whose
/// material gives a loss of its own adds that instead of 100 w l.
/// Source: the 2007 thesis, algorithm 1; formula of ITU-R P.1238-2.
struct Raytrace2007 {
    static constexpr std::string_view name = "raytrace_2007";

    double coefficient = 30;  ///< N [-], > 0
    double wall_factor = 1;   ///< w [dB/cm], >= 0

    static constexpr auto fields() {
        return describe(field("coefficient", &Raytrace2007::coefficient, positive,
                              "N, distance power loss coefficient"),
                        field("wall_factor", &Raytrace2007::wall_factor, non_negative,
                              "loss in decibels per centimetre of wall"));
    }

    LossShape shape() const { return LossShape::by_walls; }

    Meters reach(Db loss, Hertz f) const;
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;

  private:
    void loss_by_materials(const LinkBatch&, Db give_up, std::span<double> out_db) const;
};

}  // namespace rovernet
