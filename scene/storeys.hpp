// SPDX-License-Identifier: MIT
#pragma once

#include "scene/materials/material.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace rovernet {

/// Value of a storey height [m] that is not given: infinity. With this value a propagation model
/// counts no floors between antennas.
inline constexpr Meters no_storeys{std::numeric_limits<double>::infinity()};

/// Storeys of a scene, from the lowest: heights of their floors, and the ceilings between them.
///
/// A storey extends from its floor to below the next floor. The lowest storey has no lower end, the
/// highest storey has no upper end. Ceilings are thin and have no holes. The loss of a ceiling
/// depends on its material or on the propagation model.
class Storeys {
  public:
    /// Makes one storey that comprises all heights, with its floor at 0 m.
    Storeys() = default;
    /// @param floors    heights of the floors [m], ascending, at least one
    /// @param ceilings  materials of the ceilings of all storeys but the highest; empty: the
    ///                  propagation model gives their loss
    /// @throws std::invalid_argument if the number of ceilings does not match
    Storeys(std::vector<double> floors, std::vector<Material> ceilings);

    /// Number of storeys, at least 1.
    std::size_t size() const { return floors_.size(); }
    /// Number of the storey at a height z [m]; the lowest is 0.
    std::size_t number_at(double z) const { return floors_.size() == 1 ? 0 : highest_below(z); }
    /// Height of a storey's floor [m].
    double floor(std::size_t number) const { return floors_[number]; }
    /// Lower and upper end of a storey [m]. The lower end is its floor, or -infinity for the lowest
    /// storey. The upper end is the next floor, or infinity for the highest storey.
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
