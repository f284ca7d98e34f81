// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Strength of a signal at a station, by the signal's effect on the station; strongest first.
///
/// - decodable: the frame is received, without interference
/// - detectable: the station senses that the medium is busy
/// - interfering: the frame interferes with other frames
enum class Strength { decodable, detectable, interfering };

/// Method by which the receivers of a signal are determined: the fastest that the propagation model
/// allows. All three methods give exactly the result of by_loss; they differ in computing time.
enum class Decision {
    /// Receivers are determined by distance alone.
    by_range,
    /// Receivers are determined by distance and the shadowing draw of the pair.
    by_table,
    /// Receivers are determined by the loss that the model computes.
    by_loss,
};

}  // namespace rovernet
