// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/access.hpp"
#include "sim/fields.hpp"

#include <memory>
#include <string_view>

namespace rovernet {

/// Access model "one_slot": a frame is transmitted after a random time of up to `wait`, even during
/// other frames.
struct OneSlot {
    static constexpr std::string_view name = "one_slot";

    Duration wait{10'000'000};  ///< longest random wait [ns]

    static constexpr auto fields() {
        return describe(field("wait", &OneSlot::wait, non_negative, "longest time before a frame"));
    }

    std::unique_ptr<Access> make_access() const;
};

}  // namespace rovernet
