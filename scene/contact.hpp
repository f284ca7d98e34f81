// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Contact of a disc-shaped robot with an obstacle. The disc cannot move in a direction that
/// differs from `towards` by less than `half_angle`.
struct Contact {
    /// Direction from the disc's centre to the obstacle's nearest point [rad], counter-clockwise
    /// from the x axis.
    double towards;
    /// Half of the blocked range of directions [rad]: pi / 2 at a flat side of the obstacle, less
    /// at a corner that the disc does not quite touch.
    double half_angle;
};

/// Largest gap [m] between a disc and an obstacle that counts as a contact. Robots stop a
/// micrometre before an obstacle.
inline constexpr double contact_gap = 2e-6;

}  // namespace rovernet
