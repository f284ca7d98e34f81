// SPDX-License-Identifier: MIT
#include "study/control_variate.hpp"

#include "study/statistics/arguments.hpp"
#include "study/statistics/summary.hpp"

#include <cmath>
#include <stdexcept>

namespace rovernet {

std::optional<ControlVariate> control_variate(std::span<const double> expensive,
                                              std::span<const double> cheap) {
    constexpr std::string_view owner = "control_variate";
    const std::size_t n = expensive.size(), m = cheap.size();
    if (m < n) {
        throw std::invalid_argument("control_variate: needs a cheap run for each expensive one");
    }
    check_finite(expensive, owner);
    check_finite(cheap, owner);
    if (n < 2) return std::nullopt;
    const Summary of_expensive = *summary_of(expensive), paired = *summary_of(cheap.first(n)),
                  all = *summary_of(cheap);
    double products = 0;
    for (std::size_t i = 0; i < n; ++i) {
        products += (expensive[i] - of_expensive.mean) * (cheap[i] - paired.mean);
    }
    const double covariance = products / static_cast<double>(n - 1);
    const double s_h = *of_expensive.standard_deviation, s_l = *paired.standard_deviation;
    if (s_h == 0 || s_l == 0) return std::nullopt;
    ControlVariate out;
    out.beta = covariance / (s_l * s_l);
    out.rho = covariance / (s_h * s_l);
    out.estimate = of_expensive.mean + out.beta * (all.mean - paired.mean);
    out.standard_error_without = s_h / std::sqrt(static_cast<double>(n));
    const double share = 1 - static_cast<double>(n) / static_cast<double>(m);
    out.standard_error = out.standard_error_without * std::sqrt(1 - share * out.rho * out.rho);
    return out;
}

std::optional<BestMix> best_mix(double rho, double w) {
    const double explained = rho * rho, rest = 1 - explained;
    if (!(rest > 0) || !(w > 0) || w * explained <= rest) return std::nullopt;
    const double root = std::sqrt(rest) + std::sqrt(explained / w);
    if (root >= 1) return std::nullopt;
    return BestMix{.ratio = std::sqrt(w * explained / rest), .saving = 1 / (root * root)};
}

}  // namespace rovernet
