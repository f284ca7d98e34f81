// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation_model.hpp"

// Unit disc, the simplest propagation model: geometry without physics.

namespace rovernet {

/// Unit disc: loss of 0 dB within the range, the range itself included, and 1000 dB beyond it.
///
/// A link is decided by distance, not by decibels. There are no signal levels: use the unit disc
/// for geometry, not for link margins, and not with reception model "sinr".
///
/// `rovernet loss disc range=50 --distance 50,51` prints "in range" and "out of range".
///
/// Source: the 2007 thesis (docs/formats/worlds.md), model "simple"; link iff d <= range.
struct Disc {
    static constexpr std::string_view name = "disc";
    /// Loss beyond the range [dB], larger than any link budget.
    static constexpr double outside_db = 1000;

    /// Radius of the disc [m], >= 0; required (no default).
    Meters range{unset};

    static constexpr auto fields() {
        return describe(
            field("range", &Disc::range, non_negative, "radius of the disc").by_decisions());
    }

    LossShape shape() const { return LossShape::by_distance; }

    /// Distance [m] beyond which the loss is more than `loss`.
    Meters reach(Db loss, Hertz /*frequency*/) const {
        return loss.value < outside_db ? range : Meters{std::numeric_limits<double>::infinity()};
    }

    /// Fills out_db[i] with the loss [dB] to receiver i: 0 or outside_db.
    void loss(const LinkBatch& links, Db /*cutoff*/, std::span<double> out_db) const {
        const double R2 = range.value * range.value;
        for (std::size_t i = 0; i < out_db.size(); ++i) {
            out_db[i] = squared_distance(links.from, links.to[i]) <= R2 ? 0 : outside_db;
        }
    }
};

}  // namespace rovernet
