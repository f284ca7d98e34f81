// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

namespace rovernet {

/// Ray rule of the 2007 thesis [dB], for d >= 1 m, held at its value at 1 m below:
///
///   L = 20 log10 f + N log10 d - 28 + 100 w l      (f in MHz, d in m, l metres of wall)
///
/// There is one straight ray: no reflection, no diffraction. A link that is lost without its walls
/// is given up before any wall is looked for, and a ray is given up once its walls have spent the
/// budget.
///
/// The wall factor w is in dB per centimetre; real walls have 0.15 (wood) to 0.9 (chipboard), so
/// that the values of old world files (6 to 100) suit walls drawn a few pixels thin only. N holds
/// the walls of a usual building already: take N = 20 when the map shows them all. A wall whose
/// material gives a loss of its own adds that instead of 100 w l. A ceiling adds what its material
/// gives, or nothing: the rule has no loss of a floor.
///
/// `rovernet loss raytrace_2007 coefficient=20 --distance 20 --wall 0.5` prints 115.80 dB at 2450
/// MHz: 65.80 dB, and 50 dB of wall.
///
/// Source: the 2007 thesis, algorithm 1; formula of ITU-R P.1238-2.
struct Raytrace2007 {
    static constexpr std::string_view name = "raytrace_2007";

    /// Distance power loss coefficient N [-], > 0.
    double coefficient = 30;
    /// Wall factor w [dB/cm], >= 0.
    double wall_factor = 1;

    static constexpr auto fields() {
        return describe(field("coefficient", &Raytrace2007::coefficient, positive,
                              "N, distance power loss coefficient"),
                        field("wall_factor", &Raytrace2007::wall_factor, non_negative,
                              "loss in decibels per centimetre of wall"));
    }

    LossShape shape() const { return LossShape::by_walls; }

    /// Distance [m] beyond which the loss is more than `loss`: without walls.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] [dB] for the i-th receiver; walls come from the scene of the batch.
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;

  private:
    // Losses where walls have materials of their own.
    void loss_by_materials(const LinkBatch&, Db give_up, std::span<double> out_db) const;
};

}  // namespace rovernet
