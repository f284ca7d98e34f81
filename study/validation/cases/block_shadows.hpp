// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Excess loss [dB] over free space of a 2450 MHz wave behind a block. The source is at (-8 m, 0.3
/// m). The receiver takes the mean power within 15 cm of (8 m, y). The block covers -width / 2 to
/// width / 2 in x and 0 to 1 m in y. The field is 0 on the block's sides.
///
/// Accuracy: 0.3 dB. Computed by a two-dimensional boundary integral over the block's outline,
/// without ray optics; test/study/validation/cases/block_shadows_test.cpp repeats the computation.
struct BlockShadow {
    double width, y;  ///< width of the block, and y of the receiver [m]
    double loss;      ///< excess loss over free space [dB]
};
inline constexpr BlockShadow block_shadows[] = {
    {0.3, 0.2, 14.38}, {0.3, 0.5, 13.94}, {0.3, 0.9, 13.91}, {0.6, 0.2, 15.07},
    {0.6, 0.5, 15.61}, {0.6, 0.9, 15.57}, {1.0, 0.2, 15.87}, {1.0, 0.5, 17.36},
    {1.0, 0.9, 17.30}, {2.0, 0.2, 17.71}, {2.0, 0.5, 20.81}, {2.0, 0.9, 20.71}};

}  // namespace rovernet
