// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "models/variation/shadowing.hpp"
#include "sim/random.hpp"
#include "sim/units.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rovernet {

/// Propagation model with shadowing over it: L = max(0, L_model + X), see Shadowing. Medium makes
/// one of each model that it is given if its settings have shadowing; whoever asks for a loss then
/// gets it with X.
///
///   const Propagation model = Shadowed(Friis{}, {.model = ShadowingModel::link}, seed, 0);
class Shadowed {
  public:
    static constexpr std::string_view name = "shadowed";

    /// @param base  model without a random part of its own
    /// @throws std::invalid_argument if it has one, or a setting is out of its range
    Shadowed(Propagation base, const Shadowing& shadowing, std::uint64_t seed,
             std::uint32_t replication);

    /// Model without the shadowing.
    const Propagation& base() const { return base_; }

    /// Fills out_db[i] [dB] for the i-th receiver.
    void loss(const LinkBatch& links, Db give_up, std::span<double> out_db) const;
    /// Distance [m] beyond which the loss is more than `loss`, with the luckiest X.
    Meters reach(Db loss, Hertz frequency, Meters highest) const {
        return base_.reach(loss + most(), frequency, highest);
    }
    void check_frequency(Hertz frequency) const { base_.check_frequency(frequency); }
    void check_scene(const Scene& scene) const { base_.check_scene(scene); }
    /// Shape of the base, for each pair of robots; with a field: unknown.
    LossShape shape() const;
    /// Model without draws of pairs. A field stays: it is the same for all robots.
    Shadowed median() const;
    bool is_random() const { return !field_ && shadowing_.sigma > Db{0}; }

  private:
    // Most that X takes off a loss, and a hair for rounding.
    Db most() const { return {Shadowing::cut_sigmas * shadowing_.sigma.value + 1e-9}; }

    Propagation base_;
    Shadowing shadowing_;
    PairDraws draws_;
    std::optional<ShadowingField> field_;
};

}  // namespace rovernet
