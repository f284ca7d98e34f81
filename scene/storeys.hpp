// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rovernet {

/// Height of a storey in scenes where height does not define storeys [m].
inline constexpr Meters no_storeys{std::numeric_limits<double>::infinity()};

/// Storeys of a scene, from the lowest: heights of their floors, and the ceilings between them.
///
/// A storey extends from its floor to below the next floor; the lowest has no lower end, the
/// highest no upper end. Ceilings are thin and have no holes; their loss depends on the material or
/// on the propagation model.
class Storeys {
  public:
    /// One storey at all heights, with its floor at 0.
    Storeys() = default;
    /// @param floors    heights [m], ascending, at least one
    /// @param ceilings  ceilings of all storeys but the highest; empty: all follow the model
    /// @throws std::invalid_argument if the number of ceilings does not match
    Storeys(std::vector<double> floors, std::vector<Material> ceilings);

    /// Number of storeys, at least 1.
    std::size_t size() const { return floors_.size(); }
    /// Number of the storey at a height z [m]; the lowest is 0.
    std::size_t number_at(double z) const { return floors_.size() == 1 ? 0 : highest_below(z); }
    /// Height of a storey's floor [m].
    double floor(std::size_t number) const { return floors_[number]; }
    /// Height of a storey's lower and upper end [m]: its floor, or -infinity for the lowest; the
    /// next floor, or infinity for the highest.
    double bottom(std::size_t number) const;
    double top(std::size_t number) const;
    /// Ceilings between two heights [m], from the lowest; the heights may be in any order.
    std::span<const Material> ceilings_between(double z0, double z1) const;
    /// All ceilings, one for each storey except the highest.
    const std::vector<Material>& ceilings() const { return ceilings_; }

  private:
    std::size_t highest_below(double z) const;

    std::vector<double> floors_ = {0};
    std::vector<Material> ceilings_ = {};
};

}  // namespace rovernet
