// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/judge.hpp"
#include "sim/fields.hpp"

#include <memory>
#include <string_view>

namespace rovernet {

/// Reception model "preamble": only another frame in the first part of a frame destroys it, and a
/// robot that sends hears nothing.
struct Preamble {
    static constexpr std::string_view name = "preamble";

    Duration length{192'000};  ///< [ns] of the part that must be clear

    static constexpr auto fields() {
        return describe(
            field("length", &Preamble::length, non_negative, "part that must be clear"));
    }

    std::unique_ptr<Judge> make_judge() const;
};

}  // namespace rovernet
