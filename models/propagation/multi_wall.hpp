// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

#include <string_view>

namespace rovernet {

/// Multi-wall path loss [dB], for d >= 1 m. The loss is never negative. Below 1 m it is fixed at
/// its value at 1 m:
///
///   L = L0 + 10 n log10 d + sum over the walls crossed + Lf k^((k + 2) / (k + 1) - b),
/// with L0 = free space at 1 m + `excess`, n = `exponent`, Lf = `floor_loss`, b = `floor_saving`,
/// and k floors between the antennas.
///
/// The loss of a wall is that of its material. A wall whose material has no loss of its own has the
/// loss `light_wall` or `heavy_wall`. A wall is light if its drawn thickness, at the midpoint of
/// the ray's path inside the wall, is below 10 cm. A wall counts once, at any angle of crossing and
/// for any number of drawn parts, see Scene::walls(). A ceiling in a scene of several storeys has
/// the loss of its material, or else counts in k; in other scenes k counts the storeys of [scene]
/// floor_height, if given. The wall loss does not grow with the angle of crossing, unless the
/// material has a loss per metre. The loss jumps where a wall obstructs the ray, and where the
/// thickness at the midpoint passes 10 cm. Reflection and diffraction are neglected: behind many
/// walls the loss is an upper estimate.
///
/// With the defaults at 2450 MHz `rovernet loss multi_wall` prints
///
///   10 m                    60.23 dB
///   10 m, --wall 0.05       63.63 dB   a light wall
///   10 m, --wall 0.2        67.13 dB   a heavy wall
///
/// Source: COST Action 231, Digital mobile radio towards future generation systems, EUR 18957
/// (1999), section 4.7.2, with its values at 1.8 GHz: light walls 3.4 dB, heavy walls 6.9 dB,
/// floors 18.3 dB with b = 0.46.
struct MultiWall {
    static constexpr std::string_view name = "multi_wall";
    static constexpr bool is_indoor = true;

    /// Path loss exponent n [-], > 0: 2 in free space.
    double exponent = 2;
    /// Loss at 1 m in addition to free space [dB]; may be negative.
    Db excess{0};
    /// Loss of a wall thinner than 10 cm [dB], >= 0.
    Db light_wall{3.4};
    /// Loss of a wall of 10 cm or more [dB], >= 0.
    Db heavy_wall{6.9};
    /// Loss of one floor, Lf [dB], >= 0.
    Db floor_loss{18.3};
    /// Parameter b of the floor term [-], 0 to 1: the larger b, the less loss further floors add.
    double floor_saving = 0.46;

    static constexpr auto fields() {
        return describe(
            field("exponent", &MultiWall::exponent, positive,
                  "n, path loss exponent without the walls: 2 in free space")
                .linear(2),
            field("excess", &MultiWall::excess,
                  "loss at 1 m in addition to the loss of free space; `rovernet fit` can determine "
                  "this loss")
                .constant(far_from_zero),
            field("light_wall", &MultiWall::light_wall, non_negative,
                  "loss of a wall that is drawn thinner than 10 cm, if the scenario gives no loss "
                  "for its material")
                .linear(0),
            field("heavy_wall", &MultiWall::heavy_wall, non_negative,
                  "loss of a wall that is drawn 10 cm thick or thicker, if the scenario gives no "
                  "loss for its material")
                .linear(0),
            field("floor_loss", &MultiWall::floor_loss, non_negative, "loss of one floor"),
            field("floor_saving", &MultiWall::floor_saving,
                  Range{.low = 0, .high = 1, .text = "from 0 to 1"},
                  "b in the exponent of the number of floors: the larger b is, the less loss each "
                  "further floor adds"));
    }

    LossShape shape() const { return LossShape::by_walls; }

    /// Distance [m] beyond which the loss is more than `loss`, for any walls and floors.
    Meters reach(Db loss, Hertz f) const;
    /// Fills out_db[i] with the loss [dB] to receiver i, with walls and floors of links.scene.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;
    /// Loss of one crossed wall [dB]. @param material  material of the wall
    Db wall_loss(const Wall& wall, const Material& material, Hertz f) const;
};

}  // namespace rovernet
