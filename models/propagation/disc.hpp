// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

namespace rovernet {

/// Unit disc: 0 dB up to the range, the range itself included; 1000 dB beyond it.
///
/// Decided on distance, never on decibels. No levels: use it for geometry, not for margins.
/// Source: the 2007 thesis's "simple" model; link iff d <= range.
struct Disc {
    static constexpr std::string_view name = "disc";
    static constexpr double outside_db = 1000;

    Meters range{unset};  ///< [m], >= 0; there is no default

    static constexpr auto fields() {
        return describe(field("range", &Disc::range, non_negative, "radius of the disc"));
    }

    LossShape shape() const { return LossShape::by_distance; }

    Meters reach(Db loss, Hertz /*frequency*/) const {
        return loss.value < outside_db ? range : Meters{std::numeric_limits<double>::infinity()};
    }

    void loss(const LinkBatch& links, Db /*give_up*/, std::span<double> out_db) const {
        const double R2 = range.value * range.value;
        for (std::size_t i = 0; i < out_db.size(); ++i) {
            out_db[i] = squared_distance(links.from, links.to[i]) <= R2 ? 0 : outside_db;
        }
    }
};

}  // namespace rovernet
