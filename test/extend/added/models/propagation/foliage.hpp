// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/friis.hpp"

namespace rovernet {

/// Path loss [dB] through plants along the whole path:  L(d) = friis(d) + a d.
///
/// Valid for antennas within the plants, some metres apart; a is measured at the frequency in use.
/// The model neglects the ground, and the wave along the tops of the plants that dominates beyond
/// about 100 m.
struct Foliage {
    static constexpr std::string_view name = "foliage";

    DbPerMeter attenuation{0.3};  ///< a [dB/m], >= 0

    static constexpr auto fields() {
        return describe(field("attenuation", &Foliage::attenuation, non_negative,
                              "a, what a metre of plants takes"));
    }

    LossShape shape() const { return LossShape::by_distance; }

    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
        Friis{}.loss(links, cutoff, out_db);
        for (std::size_t i = 0; i < out_db.size(); ++i) {
            out_db[i] += attenuation.value * links.distance(i);
        }
    }
};

}  // namespace rovernet
