// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rovernet {

/// Height of a storey where heights tell nothing of storeys [m].
inline constexpr Meters no_storeys{std::numeric_limits<double>::infinity()};

/// Storeys of a scene, from below: the heights of their floors, and the ceilings between.
///
/// A storey goes from its floor to below the next one; the lowest has no end downwards, the highest
/// none upwards. Ceilings are thin and have no holes; what they take from a signal is up to the
/// propagation model.
class Storeys {
  public:
    /// One storey at all heights, whose floor is at 0.
    Storeys() = default;
    /// @param floors    heights [m], ascending, at least one
    /// @param ceilings  of all storeys but the highest; none: all follow the model
    /// @throws std::invalid_argument if there are others than so many ceilings
    Storeys(std::vector<double> floors, std::vector<Material> ceilings);

    /// Number of storeys, at least 1.
    std::size_t size() const { return floors_.size(); }
    /// Number of the storey at a height z [m]; the lowest is 0.
    std::size_t number_at(double z) const { return floors_.size() == 1 ? 0 : highest_below(z); }
    /// Height of a storey's floor [m].
    double floor(std::size_t number) const { return floors_[number]; }
    /// Heights between which a storey lies [m]: its floor, or -infinity for the lowest; and the
    /// next floor, or infinity for the highest.
    double bottom(std::size_t number) const;
    double top(std::size_t number) const;
    /// Ceilings between two heights [m], from below, whichever of the two is higher.
    std::span<const Material> ceilings_between(double z0, double z1) const;
    /// All ceilings, one for each storey but the highest.
    const std::vector<Material>& ceilings() const { return ceilings_; }

  private:
    std::size_t highest_below(double z) const;

    std::vector<double> floors_ = {0};
    std::vector<Material> ceilings_ = {};
};

}  // namespace rovernet
