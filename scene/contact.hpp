// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Contact of a disc with an obstacle, seen from the disc's centre: the disc cannot move in a
/// direction that differs from `towards` by less than `half_angle`.
struct Contact {
    /// Direction of the obstacle's nearest point [rad], counter-clockwise from the x axis.
    double towards;
    /// Half of the blocked angle [rad]: pi / 2 at a face, less at a corner that has a gap.
    double half_angle;
};

/// Gap below which a disc touches an obstacle [m]; robots stop a micrometre before it.
inline constexpr double contact_gap = 2e-6;

}  // namespace rovernet
