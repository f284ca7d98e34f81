// SPDX-License-Identifier: MIT
#include "study/comparison.hpp"

#include "sim/math.hpp"
#include "study/arguments.hpp"
#include "study/distributions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double power = 0.8;

void check_pairs(std::span<const double> a, std::span<const double> b, double confidence,
                 std::size_t family) {
    constexpr std::string_view owner = "compare_pairs";
    if (a.size() != b.size()) {
        throw std::invalid_argument(
            fmt::format("{}: needs pairs, got {} and {} values", owner, a.size(), b.size()));
    }
    check_finite(a, owner);
    check_finite(b, owner);
    check_open_unit(confidence, "confidence", owner);
    if (family == 0) throw std::invalid_argument(fmt::format("{}: family must be > 0", owner));
}

/// Of n >= 2 values.
double variance(const Summary& summary) {
    return *summary.standard_deviation * *summary.standard_deviation;
}

/// Of the mean of n >= 2 differences.
double standard_error(const Summary& difference) {
    return *difference.standard_deviation / std::sqrt(static_cast<double>(difference.n));
}

double degrees(const Summary& difference) { return static_cast<double>(difference.n - 1); }

double p_value(const Summary& difference) {
    const double error = standard_error(difference);
    if (error == 0) return difference.mean == 0 ? 1 : 0;
    return t_exceeded(degrees(difference), difference.mean / error);
}

std::optional<double> detectable(const Summary& difference, double level) {
    const auto shift = t_shift(degrees(difference), level, power);
    if (!shift) return std::nullopt;
    return *shift * standard_error(difference);
}

std::optional<double> variance_ratio(std::span<const double> a, std::span<const double> b,
                                     const Summary& difference) {
    const double unpaired = variance(*summary_of(a)) + variance(*summary_of(b));
    if (unpaired == 0) return std::nullopt;
    const double paired = variance(difference);
    return paired == 0 ? std::numeric_limits<double>::infinity() : unpaired / paired;
}

/// With as many decimals as show two digits of a half-width; without a half-width, six digits.
class Decimals {
  public:
    explicit Decimals(double half_width) {
        constexpr double least = 1e-12;  // below, only rounding is left
        if (half_width < least) return;
        const int exponent = static_cast<int>(std::floor(math::log10(half_width)));
        decimals_ = std::max(0, 1 - exponent);
    }

    std::string operator()(double value) const {
        if (!decimals_) return fmt::format("{:.6g}", value);
        const std::string text = fmt::format("{:.{}f}", value, *decimals_);
        const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
        return is_zero && text[0] == '-' ? text.substr(1) : text;
    }

  private:
    std::optional<int> decimals_;
};

/// "95 % 0.180 to 0.246, n = 30, Holm p < 0.001", around `middle`.
std::string evidence_text(const PairedComparison& c, double middle, double holm_p) {
    const Decimals text(c.half_width);
    return fmt::format("{:.6g} % {} to {}, n = {}, Holm p {}", 100 * c.confidence,
                       text(middle - c.half_width), text(middle + c.half_width), c.difference.n,
                       holm_p < 0.001 ? "< 0.001" : fmt::format("= {:.3f}", holm_p));
}

std::string_view side(double difference) { return difference > 0 ? "above" : "below"; }

/// When every pair differs by the same.
std::string constant_text(std::string_view a, std::string_view b, const Summary& difference) {
    const std::string where = fmt::format("in each of {} replications", difference.n);
    if (difference.mean == 0) return fmt::format("{} and {} are equal {}", a, b, where);
    return fmt::format("{} is {:.6g} {} {} {}", a, std::abs(difference.mean), side(difference.mean),
                       b, where);
}

}  // namespace

std::optional<PairedComparison> compare_pairs(std::span<const double> a, std::span<const double> b,
                                              double confidence, std::size_t family) {
    check_pairs(a, b, confidence, family);
    if (a.size() < 2) return std::nullopt;
    std::vector<double> differences(a.size());
    std::ranges::transform(a, b, differences.begin(), std::minus<>{});
    const Summary difference = *summary_of(differences);
    const double level = (1 - confidence) / static_cast<double>(family);
    return PairedComparison{.difference = difference,
                            .confidence = confidence,
                            .half_width = *half_width(difference, confidence),
                            .p = p_value(difference),
                            .detectable = detectable(difference, level),
                            .variance_ratio = variance_ratio(a, b, difference)};
}

std::vector<double> holm(std::span<const double> p) {
    for (const double each : p) {
        if (each >= 0 && each <= 1) continue;
        throw std::invalid_argument(fmt::format("holm: p must be from 0 to 1, got {}", each));
    }
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return p[i] < p[j]; });  // ties adjust alike
    std::vector<double> adjusted(p.size());
    double greatest = 0;
    for (std::size_t step = 0; step < order.size(); ++step) {
        const auto left = static_cast<double>(order.size() - step);
        greatest = std::max(greatest, std::min(1.0, left * p[order[step]]));
        adjusted[order[step]] = greatest;
    }
    return adjusted;
}

std::string comparison_text(std::string_view a, std::string_view b, const PairedComparison& c,
                            double holm_p) {
    const double mean = c.difference.mean;
    if (c.half_width == 0) return constant_text(a, b, c.difference);
    const Decimals text(c.half_width);
    if (holm_p <= 1 - c.confidence) {
        const double size = std::abs(mean);
        return fmt::format("{} is {} {} {} ({})", a, text(size), side(mean), b,
                           evidence_text(c, size, holm_p));
    }
    std::string sentence = fmt::format("no detectable difference between {} and {} ({}, {})", a, b,
                                       text(mean), evidence_text(c, mean, holm_p));
    if (c.detectable) {
        sentence += fmt::format("; a difference of {} would have been detected with {:.0f} % power",
                                text(*c.detectable), 100 * power);
    }
    return sentence;
}

}  // namespace rovernet
