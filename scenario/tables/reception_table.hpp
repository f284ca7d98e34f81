// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/list.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>

// Reception of frames in a scenario file:
//
//     [reception]
//     model = "collision"
//     capture_ratio = "10 dB"

namespace rovernet {

/// Values of [reception] model, in order of detail. The model decides whether a receiver in range
/// receives a frame.
///
/// - threshold: a frame is received if its level is above the sensitivity; frames do not interfere
/// - collision: frames that overlap are lost, except one that is stronger by the capture ratio
/// - sinr: bit errors follow from the signal to interference and noise ratio
enum class ReceptionChoice { threshold, collision, sinr };
template <>
struct EnumNames<ReceptionChoice> {
    static constexpr std::array<std::string_view, 3> values = {"threshold", "collision", "sinr"};
};

/// [reception]: the chosen model, and the parameters of all models. Parameters of a model that is
/// not chosen are checked and kept, so that changing the key `model` is enough to swap the model.
struct ReceptionTable {
    ReceptionChoice model = ReceptionChoice::threshold;
    /// Capture ratio [dB] of the model collision: a frame survives if it is stronger than the
    /// others by this.
    Db capture_ratio = Collision{}.capture_ratio;
    /// Frames that may survive a collision (model collision): only the frame that the receiver is
    /// receiving, or also a later one.
    CaptureOrder capture = Collision{}.capture;
    /// Interference cut of sinr [dB]: frames weaker than the sensitivity by more than this are
    /// ignored.
    Db interference_cut = Sinr{}.interference_cut;
    /// Preamble threshold of sinr [dB]: a receiver detects a preamble from this ratio of signal to
    /// noise and interference on.
    Db preamble_threshold = Sinr{}.preamble_threshold;

    static constexpr auto fields() {
        return describe(
            field("model", &ReceptionTable::model,
                  "threshold: by the link budget alone; collision: frames that overlap are lost; "
                  "sinr: by errors in the bits"),
            field("capture_ratio", &ReceptionTable::capture_ratio, positive,
                  "how much stronger a frame is that survives another"),
            field("capture", &ReceptionTable::capture,
                  "which of two frames may survive: the first, or also the later one"),
            field("interference_cut", &ReceptionTable::interference_cut, non_negative,
                  "of sinr: frames weaker than the sensitivity by this are left out"),
            field("preamble_threshold", &ReceptionTable::preamble_threshold,
                  "of sinr: a receiver finds preambles that are so much above the rest"));
    }
    /// Chosen model with its parameters. network_settings() calls it.
    ReceptionModel make() const;
};

}  // namespace rovernet
