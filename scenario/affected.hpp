// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/unlikely.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <vector>

namespace rovernet {

/// Notice to the user about several robots: text about the first robot, number of further robots.
struct Affected {
    std::string first;
    std::size_t others = 0;

    void add(const auto& words) {
        if (first.empty()) {
            first = words();
        } else {
            ++others;
        }
    }
    void note(std::vector<std::string>& notices) const {
        if (first.empty()) return;
        add_notice(notices,
                   others == 0 ? first : fmt::format("{}; and {} more like this", first, others));
    }
};

}  // namespace rovernet
