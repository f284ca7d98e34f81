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

/// Everything that a validation has found.
struct Validation {
    ValidationSize size;
    std::vector<ValidationChart> charts = {};
    std::vector<Promise> promises = {};
    std::vector<std::string> left_out = {};  ///< what was not looked at, and why

    /// Whether every promise was kept.
    bool kept() const;
};

/// Makes all charts and checks all promises: errors of this build, and its costs on this machine.
/// @param field  folder of measurements, see measured_flat(); without it their chart is left out
/// @param tell   told what is done next; may be empty
/// @throws InputError for a damaged folder of measurements
Validation validate(const ValidationSize& size, const std::optional<std::string>& field,
                    const std::function<void(std::string_view)>& tell);

}  // namespace rovernet
