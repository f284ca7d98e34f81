// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/list.hpp"
#include "scenario/tables/reader.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>

// Reception of frames as a scenario file gives it:
//
//     [reception]
//     model = "collision"
//     capture_ratio = "10 dB"

namespace rovernet {

/// Words of [reception] model, the most detailed last: what becomes of a frame at a receiver that
/// it reaches.
///
/// - threshold: it is received wherever the link budget allows it; frames do not interfere
/// - collision: of frames that overlap one survives if it is stronger by the capture ratio
/// - sinr: bits are lost by the ratio of signal to noise and interference
enum class ReceptionChoice { threshold, collision, sinr };
template <>
struct EnumNames<ReceptionChoice> {
    static constexpr std::array<std::string_view, 3> values = {"threshold", "collision", "sinr"};
};

/// [reception]: the chosen model, and the parameters of all. One for a model that is not chosen is
/// checked and kept, so that one key swaps the model.
struct ReceptionTable {
    ReceptionChoice model = ReceptionChoice::threshold;
    /// Ratio [dB] of collision by which a frame that survives another is stronger.
    Db capture_ratio = Collision{}.capture_ratio;
    /// Frame of collision that may survive: only the one that the receiver is at, or a later one,
    /// too.
    CaptureOrder capture = Collision{}.capture;
    /// Cut of sinr [dB]: frames weaker than the sensitivity by this are left out.
    Db interference_cut = Sinr{}.interference_cut;
    /// Ratio of sinr [dB] above noise and interference from which on a receiver finds a preamble.
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
    /// Chosen model with its parameters. network_settings() asks for it.
    ReceptionModel make() const;
};

}  // namespace rovernet
