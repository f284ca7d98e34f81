// SPDX-License-Identifier: MIT
#pragma once

#include "sim/time.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace rovernet {

/// Time >= 0 in seconds with all nine decimals, exact at any time.
inline std::string exact_seconds(Time t) {
    const std::int64_t ns = t.time_since_epoch().count();
    return fmt::format("{}.{:09}", ns / 1'000'000'000, ns % 1'000'000'000);
}

}  // namespace rovernet
