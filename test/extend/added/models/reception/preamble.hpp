// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/judge.hpp"
#include "sim/fields.hpp"

#include <memory>
#include <string_view>

namespace rovernet {

/// Reception model "preamble": a frame is lost only if another frame overlaps its first part. A
/// transmitting robot receives nothing.
struct Preamble {
    static constexpr std::string_view name = "preamble";

    Duration length{192'000};  ///< length [ns] of the first part, which no other frame may overlap

    static constexpr auto fields() {
        return describe(
            field("length", &Preamble::length, non_negative, "part that must be clear"));
    }

    std::unique_ptr<Judge> make_judge() const;
};

}  // namespace rovernet
