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

// Localisation by received levels: a receiver estimates its position from the levels of
// transmitters at known positions (anchors). Shadowing limits the accuracy.

namespace rovernet {

/// Loss of a signal from an anchor (transmitter of known position): transmit power plus antenna
/// gains minus received level.
struct AnchorLoss {
    Vec3 anchor;  ///< position of the anchor's antenna [m]
    double loss;  ///< loss of the signal [dB]
};

/// Settings of a Locator.
struct LocatorSettings {
    Propagation model;  ///< propagation model, of which the median loss is used
    std::shared_ptr<const Scene> scene = std::make_shared<Scene>();
    Meters floor_height = no_storeys;
    Hertz frequency;
    Vec3 low, high;  ///< lowest and highest corner of the search area [m]; z is ignored
    /// True: the transmit power is known, so that losses are absolute. False: all losses have an
    /// unknown common offset, which the locator also estimates.
    bool knows_power = true;
};

/// Maximum-likelihood estimator of the position at which losses were measured, for independent
/// normal errors [dB] of equal variance:
///
///   (x, y) = arg min  sum over the anchors i of (L_i - L(a_i, (x, y)) - c)^2,
///
/// where L_i is the loss measured from anchor i, L the loss by the model, and a_i the anchor's
/// position. If the power is known, c = 0; otherwise c is the mean of L_i - L. If several positions
/// are equally likely, any one is returned (three anchors on a line cannot distinguish the sides of
/// the line).
///
/// The search uses a grid of 48 by 48 points over the area, then a refinement around each local
/// minimum, to 1 mm.
class Locator {
  public:
    explicit Locator(LocatorSettings settings);

    /// Most likely position [m].
    /// @param z  height of the antenna [m], known
    Vec3 locate(std::span<const AnchorLoss> losses, double z);

    /// Cramer-Rao lower bound on the rms error [m] of any unbiased estimate of the position `at`
    /// from these anchors: sqrt(trace F^-1) with
    ///
    ///   F = sum over i of g_i g_i^T / sigma^2,   g_i the gradient of the loss [dB/m],
    ///
    /// with one more row and column if the power is not known. For log_distance with exponent n,
    /// F = b^2 sum u_i u_i^T / d_i^2 with b = 10 n / (sigma ln 10), and d_i and u_i the
    /// distance and direction of anchor i. None if the anchors do not determine the position. The
    /// gradient is a difference quotient over 1 mm; at the edge of a wall's shadow it is undefined.
    /// Source: N. Patwari et al., Relative location estimation in wireless sensor networks, IEEE
    /// Trans. Signal Processing 51(8), 2003.
    std::optional<Meters> bound(std::span<const Vec3> anchors, Vec3 at, Db sigma) const;

  private:
    using Grid = std::vector<double>;  // loss at each grid point [dB]

    void losses_from(Vec3 anchor, std::span<const Vec3> to, std::span<double> out) const;
    const Grid& grid_of(Vec3 anchor, double z);
    std::vector<Vec3> valleys(std::span<const AnchorLoss> losses, double z);
    std::pair<double, Vec3> refined(std::span<const AnchorLoss> losses, Vec3 from) const;
    /// Sum of squared errors of losses [dB^2]. If the power is not known, the mean error is
    /// subtracted from each error before squaring.
    /// @param losses   number of losses
    /// @param squares  sum of squared errors [dB^2]
    /// @param sum      sum of the errors [dB]
    double misfit(std::size_t losses, double squares, double sum) const;
    Vec3 point(int i, int j, double z) const;

    LocatorSettings settings_;
    // Losses on the search grid by key: x, y, z of the anchor, and height of the receiver [m].
    std::map<std::tuple<double, double, double, double>, Grid> grids_;
};

}  // namespace rovernet
