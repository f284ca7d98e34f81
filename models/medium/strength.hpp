// SPDX-License-Identifier: MIT
#pragma once

namespace rovernet {

/// Strength of a signal: what it is strong enough for, strongest first.
///
/// - decodable: its frame is received, if nothing interferes
/// - detectable: the station senses that the medium is busy
/// - interfering: it interferes with other frames
enum class Strength { decodable, detectable, interfering };

/// Way in which it is decided for whom a signal is strong enough: the cheapest that its model
/// allows. All three agree with the loss to the last bit; they differ in what a look at a pair
/// costs.
enum class Decision {
    /// By the distance alone.
    by_range,
    /// By the distance and a draw of the pair.
    by_table,
    /// By asking the model for the loss.
    by_loss,
};

}  // namespace rovernet
