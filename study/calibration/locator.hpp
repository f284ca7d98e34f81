// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scene/scene.hpp"
#include "sim/geometry.hpp"
#include "sim/units.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

// Places from received levels: who hears transmitters at known places (anchors) can tell from the
// levels where it is, as well as shadowing allows.

namespace rovernet {

/// Loss of a signal from an anchor: its power and the gains, less the received level.
struct AnchorLoss {
    Vec3 anchor;  ///< its antenna [m]
    double loss;  ///< [dB]
};

/// What a Locator knows.
struct LocatorSettings {
    Propagation model;  ///< its median counts
    std::shared_ptr<const Scene> scene = std::make_shared<Scene>();
    Meters floor_height = no_storeys;
    Hertz frequency;
    Vec3 low, high;  ///< corners of the area of all places [m]; z does not count
    bool knows_power =
        true;  ///< false: all losses are off by one constant, which is estimated, too
};

/// Finder of the place that losses were most likely measured at, with errors that are normal [dB],
/// independent, and as large for each anchor:
///
///   (x, y) = arg min  sum over the anchors i of (L_i - L(a_i, (x, y)) - c)^2,
///
/// c = 0, or the mean error if the power is not known. Of places that explain the levels equally
/// well one is told: three anchors on a line cannot tell its two sides apart.
///
/// It looks at a grid of the area first (48 by 48 points), then around each of its valleys, to
/// 1 mm.
class Locator {
  public:
    explicit Locator(LocatorSettings settings);

    /// The most likely place.
    /// @param z  height of the antenna [m], known
    Vec3 locate(std::span<const AnchorLoss> losses, double z);

    /// Bound of Cramer and Rao on the rms error [m] of any unbiased estimate of the place `at` from
    /// these anchors: sqrt(trace F^-1) with
    ///
    ///   F = sum over i of g_i g_i^T / sigma^2,   g_i the gradient of the loss [dB/m],
    ///
    /// with one more row and column if the power is not known. For log_distance that is
    /// F = b^2 sum u_i u_i^T / d_i^2 with b = 10 n / (sigma ln 10). Nothing if they do not tell the
    /// place. The gradient is taken over 1 mm: where a wall's shadow begins there is none.
    /// Source: N. Patwari et al., Relative location estimation in wireless sensor networks, IEEE
    /// Trans. Signal Processing 51(8), 2003.
    std::optional<Meters> bound(std::span<const Vec3> anchors, Vec3 at, Db sigma) const;

  private:
    using Grid = std::vector<double>;  // loss at each of the points [dB]

    void losses_from(Vec3 anchor, std::span<const Vec3> to, std::span<double> out) const;
    const Grid& grid_of(Vec3 anchor, double z);
    std::vector<Vec3> valleys(std::span<const AnchorLoss> losses, double z);
    std::pair<double, Vec3> refined(std::span<const AnchorLoss> losses, Vec3 from) const;
    /// Sum of squared errors of so many losses, less that of their mean if the power is not known.
    double misfit(std::size_t losses, double squares, double sum) const;
    Vec3 point(int i, int j, double z) const;

    LocatorSettings settings_;
    std::map<std::tuple<double, double, double, double>, Grid> grids_;  // by anchor, and height
};

}  // namespace rovernet
