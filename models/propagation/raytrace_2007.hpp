// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

namespace rovernet {

/// Path loss [dB] by the ray rule of the 2007 thesis (docs/formats/worlds.md), for d >= 1 m; below
/// 1 m the loss is fixed at its value at 1 m:
///
///   L = 20 log10 f + N log10 d - 28 + 100 w l      (f in MHz, d in m, l metres of wall)
///
/// There is only the straight ray, without reflection and diffraction. The computation stops once
/// the loss exceeds the cut-off: before the search for walls if the loss without walls does, or
/// else at the wall that raises the sum above the cut-off.
///
/// The wall factor w is in dB per centimetre; real walls have 0.15 (wood) to 0.9 (chipboard), so
/// the values of old world files (6 to 100) only fit walls drawn a few pixels thin. N already
/// includes the walls of an average building: use N = 20 if the map shows all walls. A wall whose
/// material has a loss of its own adds that loss instead of 100 w l. A ceiling adds the loss of its
/// material, or nothing: the rule has no floor loss.
///
/// `rovernet loss raytrace_2007 coefficient=20 --distance 20 --wall 0.5` prints 115.80 dB at 2450
/// MHz: 65.80 dB, and 50 dB of wall.
///
/// Source: the 2007 thesis, algorithm 1; formula of ITU-R P.1238-2.
struct Raytrace2007 {
    static constexpr std::string_view name = "raytrace_2007";
    static constexpr bool is_indoor = true;

    /// Distance power loss coefficient N [-], > 0.
    double coefficient = 30;
    /// Wall factor w [dB/cm], >= 0.
    double wall_factor = 1;

    static constexpr auto fields() {
        return describe(
            field("coefficient", &Raytrace2007::coefficient, positive,
                  "N, distance power loss coefficient")
                .linear(30),
            field("wall_factor", &Raytrace2007::wall_factor, non_negative,
                  "loss in decibels for each centimetre of the signal path that is inside walls")
                .linear(0));
    }

    LossShape shape() const { return LossShape::by_walls; }

    /// Distance [m] beyond which the loss is more than `loss`, for any walls.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] with the loss [dB] to receiver i; walls come from the scene of the batch.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;

  private:
    // Function loss() for a scene with materials that have losses of their own.
    void loss_by_materials(const LinkBatch&, Db cutoff, std::span<double> out_db) const;
};

}  // namespace rovernet
