// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Loss of a wave at 2450 MHz past a block 1 m deep over that in the open [dB]: mean power within
/// 15 cm of (8 m, y), from (-8 m, 0.3 m); the block reaches from -width / 2 to width / 2 in x, and
/// from 0 to 1 m in y. The field is 0 on its sides.
///
/// Within 0.3 dB. Computed as an integral over the block's outline in two dimensions, without any
/// optics: test/study/validation/block_shadows_test.cpp computes it anew.
struct BlockShadow {
    double width, y;  ///< [m]
    double loss;      ///< [dB]
};
inline constexpr BlockShadow block_shadows[] = {
    {0.3, 0.2, 14.38}, {0.3, 0.5, 13.94}, {0.3, 0.9, 13.91}, {0.6, 0.2, 15.07},
    {0.6, 0.5, 15.61}, {0.6, 0.9, 15.57}, {1.0, 0.2, 15.87}, {1.0, 0.5, 17.36},
    {1.0, 0.9, 17.30}, {2.0, 0.2, 17.71}, {2.0, 0.5, 20.81}, {2.0, 0.9, 20.71}};

}  // namespace rovernet
