// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "models/variation/shadowing_field.hpp"
#include "sim/random.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rovernet {

/// Propagation model with added shadowing X: L = max(0, L_model + X) [dB], see Shadowing. If its
/// settings have shadowing with sigma > 0, Medium replaces each of its models by a Shadowed.
///
///   const Propagation model = Shadowed(Friis{}, {.model = ShadowingModel::link}, seed, 0);
class Shadowed {
  public:
    static constexpr std::string_view name = "shadowed";

    /// @param base  model without a random part
    /// @throws std::invalid_argument if `base` has a random part, or a setting is out of its range
    Shadowed(Propagation base, const Shadowing& shadowing, std::uint64_t seed,
             std::uint32_t replication);

    /// Propagation model without the shadowing.
    const Propagation& base() const { return base_; }
    const Shadowing& shadowing() const { return shadowing_; }

    /// Fills out_db[i] with the loss [dB] to receiver i.
    void loss(const LinkBatch& links, Db cutoff, std::span<double> out_db) const;
    /// Distance [m] beyond which the loss is more than `loss`, even for the most favourable
    /// shadowing.
    Meters reach(Db loss, Hertz frequency, Meters highest) const {
        return base_.reach(loss + most(), frequency, highest);
    }
    void check_frequency(Hertz frequency) const { base_.check_frequency(frequency); }
    void check_scene(const Scene& scene) const { base_.check_scene(scene); }
    /// Shape of the loss: `unknown` with a shadowing field, by_pair if the shape of base() is
    /// by_distance, otherwise the shape of base().
    LossShape shape() const;
    /// Model without the random draws of pairs of robots. A shadowing field remains, because it is
    /// the same for all robots.
    Shadowed median() const;
    bool is_random() const { return !field_ && shadowing_.sigma > Db{0}; }

  private:
    // Largest reduction [dB] of a loss by the shadowing X, plus a margin for rounding.
    Db most() const { return {Shadowing::cut_sigmas * shadowing_.sigma.value + 1e-9}; }

    Propagation base_;
    Shadowing shadowing_;
    PairDraws draws_;
    std::optional<ShadowingField> field_;
};

}  // namespace rovernet
