// SPDX-License-Identifier: MIT
#include "models/medium/shadowed.hpp"

#include "sim/fields.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace rovernet {

Shadowed::Shadowed(Propagation base, const Shadowing& shadowing, std::uint64_t seed,
                   std::uint32_t replication)
    : base_(std::move(base)),
      shadowing_(shadowing),
      draws_(seed, replication, Purpose::link_shadowing) {
    check_fields(shadowing, "shadowing");
    if (base_.is_random()) {
        throw std::invalid_argument(
            "shadowing: the propagation model " + std::string(base_.name()) +
            " already draws random losses; expected sigma = 0 dB in this propagation model");
    }
    if (shadowing.model == ShadowingModel::field) {
        field_.emplace(shadowing.decorrelation_distance, seed, replication);
    }
}

LossShape Shadowed::shape() const {
    if (field_) return LossShape::unknown;
    const LossShape shape = base_.shape();
    return shape == LossShape::by_distance ? LossShape::by_pair : shape;
}

Shadowed Shadowed::median() const {
    Shadowed median = *this;
    if (!field_) median.shadowing_.sigma = Db{0};
    return median;
}

void Shadowed::loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const {
    base_.loss(links, cutoff + most(), out_db);
    constexpr double cut = Shadowing::cut_sigmas;
    for (std::size_t i = 0; i < out_db.size(); ++i) {
        const double x =
            field_ ? (*field_)(links.from, links.to[i])
                   : std::clamp(draws_.normal(links.from_key, links.to_keys[i]), -cut, cut);
        out_db[i] = std::max(0.0, out_db[i] + shadowing_.sigma.value * x);
    }
}

}  // namespace rovernet
