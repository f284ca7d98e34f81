// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/judge.hpp"
#include "sim/fields.hpp"

#include <memory>
#include <string_view>

// Reception by the signal to interference and noise ratio (SINR). In code:
//
//     Network network({.propagation = LogDistance{}, .reception = Sinr{.interference_cut =
//     Db{30}}});
//
// This header has the settings. sinr_receiver.hpp has the rule for one receiver, which
// sinr_judge.cpp applies to a network.

namespace rovernet {

/// Reception model "sinr": a free receiver locks onto a frame whose preamble it detects. The
/// receiver decodes the frame with the probability that all bits are right, computed for chunks of
/// constant interference, which is the sum of all other frames on air at the receiver.
///
///   signal         |-- preamble --|=========== payload ===========|
///   other frames          |----------------|    |---------|
///   chunks                        |   1    | 2  |    3    |   4   |
///
/// A preamble is detected if its SINR is at least `preamble_threshold` 4 us after its start. Of
/// simultaneous preambles the strongest is tested first. A frame is lost if it begins while the
/// receiver is locked onto another frame or transmits, or if the receiver begins to transmit during
/// the frame. Only the payload has bit errors.
///
/// Frames weaker than the sensitivity by more than `interference_cut`, or weaker than the noise
/// floor by more than 10 dB, are neglected (for the error see Network::interference_left_out).
///
/// Sources: the physical layer's error rates; IEEE 802.11-2020, clauses 15-18, for the receiver;
/// ns-3.37's ThresholdPreambleDetectionModel for the threshold and the time of detection.
struct Sinr {
    static constexpr std::string_view name = "sinr";

    /// Cut-off of interference [dB], >= 0: frames weaker than the sensitivity by more than this
    /// ratio are neglected.
    Db interference_cut{20};
    /// Smallest SINR [dB] at which a preamble is detected.
    Db preamble_threshold{4};

    static constexpr auto fields() {
        return describe(field("interference_cut", &Sinr::interference_cut, non_negative,
                              "a frame whose level is below the sensitivity by more than this "
                              "ratio does not count as interference"),
                        field("preamble_threshold", &Sinr::preamble_threshold,
                              "smallest ratio of signal to interference and noise (SINR) at which "
                              "a receiver detects a preamble"));
    }

    /// Creates the judge for one Network.
    std::unique_ptr<Judge> make_judge() const;
};

}  // namespace rovernet
