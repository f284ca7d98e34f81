// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/validation_chart.hpp"
#include "study/validation/validation_charts.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Results of `rovernet validate`: charts, and checked error limits.
struct Validation {
    ValidationSize size;
    std::vector<ValidationChart> charts = {};
    std::vector<Promise> promises = {};
    std::vector<std::string> left_out = {};  ///< sentences on skipped checks, with reasons

    /// Whether every checked error is within its claimed limit.
    bool kept() const;
};

/// Makes all charts and checks all claimed error limits. Errors are measured with this build, costs
/// on this machine.
/// @param field  folder of measurements, see measured_flat(); none: no chart of measurements
/// @param tell   called with the name of the next step; may be empty
/// @throws InputError for a damaged folder of measurements
Validation validate(const ValidationSize& size, const std::optional<std::string>& field,
                    const std::function<void(std::string_view)>& tell);

}  // namespace rovernet
