// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/list.hpp"
#include "scenario/reader.hpp"
#include "sim/fields.hpp"

#include <array>
#include <string_view>

namespace rovernet {

/// How a frame is received.
enum class ReceptionChoice { threshold, collision, sinr };
template <>
struct EnumNames<ReceptionChoice> {
    static constexpr std::array<std::string_view, 3> values = {"threshold", "collision", "sinr"};
};

/// [reception]
struct ReceptionTable {
    ReceptionChoice model = ReceptionChoice::threshold;
    Db capture_ratio = Collision{}.capture_ratio;
    CaptureOrder capture = Collision{}.capture;
    Db interference_cut = Sinr{}.interference_cut;
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
    ReceptionModel make() const;
};

}  // namespace rovernet
