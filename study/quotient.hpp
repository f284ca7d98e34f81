// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace rovernet {

/// Quotient of two metrics, which users write as "A/B".
struct Quotient {
    std::string over, under;  ///< names of the metrics A and B
};
/// Parts of the name of a quotient; empty if the name has no slash. The name of a single metric may
/// have a slash in the name of a flow: callers first search for a metric of the whole name.
inline std::optional<Quotient> quotient_of(const std::string& metric) {
    const auto slash = metric.find('/');
    if (slash == std::string::npos) return std::nullopt;
    return Quotient{metric.substr(0, slash), metric.substr(slash + 1)};
}

}  // namespace rovernet
