// SPDX-License-Identifier: MIT
#include "study/comparison.hpp"

#include "sim/math.hpp"
#include "study/arguments.hpp"
#include "study/distributions.hpp"
#include "study/interval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double power = 0.8;

/// The differences of pairs. @throws std::invalid_argument
std::vector<double> differences_of(std::span<const double> a, std::span<const double> b) {
    constexpr std::string_view owner = "compare_pairs";
    if (a.size() != b.size()) {
        throw std::invalid_argument(
            fmt::format("{}: needs pairs, got {} and {} values", owner, a.size(), b.size()));
    }
    check_finite(a, owner);
    check_finite(b, owner);
    std::vector<double> differences(a.size());
    std::ranges::transform(a, b, differences.begin(), std::minus<>{});
    return differences;
}

/// Variance of n >= 2 values.
double variance(const Summary& summary) {
    return *summary.standard_deviation * *summary.standard_deviation;
}

/// Standard error of the mean of n >= 2 differences.
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

/// Level by betting: the least at which the interval leaves 0 out, between 1e-6 and 1.
double betting_p(std::span<const double> differences, const Bounds& bounds) {
    const auto leaves_out = [&](double level) {
        const auto interval = interval_of(differences, bounds, 1 - level);
        return interval->low > 0 || interval->high < 0;
    };
    constexpr double least = 1e-6, precision = 1.0001;  // ratio
    double no = least, yes = 1;
    if (leaves_out(least)) return least;
    while (yes / no > precision) {
        const double middle = std::sqrt(no * yes);
        (leaves_out(middle) ? yes : no) = middle;
    }
    return yes;
}

/// Number with as many decimals as show two digits of a half-width; without a half-width, six
/// digits.
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

double half_width_of(const PairedComparison& c) { return (c.high - c.low) / 2; }

/// "95 % 0.180 to 0.246, n = 30, p < 0.001"; with the sign of everything changed if `turned`.
std::string evidence_text(const PairedComparison& c, bool turned) {
    const Decimals text(half_width_of(c));
    return fmt::format("{:.6g} %{} {} to {}, n = {}, p {}", 100 * c.confidence,
                       c.family > 1 ? fmt::format(" for all {}:", c.family) : "",
                       text(turned ? -c.high : c.low), text(turned ? -c.low : c.high),
                       c.difference.n, c.p < 0.001 ? "< 0.001" : fmt::format("= {:.3f}", c.p));
}

std::string_view side(double difference) { return difference > 0 ? "above" : "below"; }

/// Comparison in which every pair differs by the same.
std::string constant_text(std::string_view a, std::string_view b, const Summary& difference) {
    const std::string where = fmt::format("in each of {} replications", difference.n);
    if (difference.mean == 0) return fmt::format("{} and {} are equal {}", a, b, where);
    return fmt::format("{} is {:.6g} {} {} {}", a, std::abs(difference.mean), side(difference.mean),
                       b, where);
}

}  // namespace

std::optional<PairedComparison> compare_pairs(std::span<const double> a, std::span<const double> b,
                                              const Bounds& bounds, double confidence,
                                              std::size_t family,
                                              std::optional<IntervalMethod> wish) {
    const std::vector<double> differences = differences_of(a, b);
    check_open_unit(confidence, "confidence", "compare_pairs");
    if (family == 0) throw std::invalid_argument("compare_pairs: family must be > 0");
    if (differences.size() < 2) return std::nullopt;
    const Summary difference = *summary_of(differences);
    const double level = (1 - confidence) / static_cast<double>(family);
    const Bounds limits = difference_bounds(bounds);
    const auto interval = interval_of(differences, limits, 1 - level, wish);
    PairedComparison c{.difference = difference,
                       .confidence = confidence,
                       .family = family,
                       .low = interval ? interval->low : difference.mean,
                       .high = interval ? interval->high : difference.mean,
                       .method = method_for(differences, limits, wish),
                       .p = 1,
                       .detectable = {}};
    const bool by_t = c.method == IntervalMethod::t;
    const double p = by_t ? p_value(difference) : betting_p(differences, limits);
    c.p = std::min(1.0, static_cast<double>(family) * p);
    if (by_t) c.detectable = detectable(difference, level);
    return c;
}

std::optional<double> paired_variance_ratio(std::span<const double> a, std::span<const double> b) {
    const std::vector<double> differences = differences_of(a, b);
    if (differences.size() < 2) return std::nullopt;
    const double unpaired = variance(*summary_of(a)) + variance(*summary_of(b));
    if (unpaired == 0) return std::nullopt;
    const double paired = variance(*summary_of(differences));
    return paired == 0 ? std::numeric_limits<double>::infinity() : unpaired / paired;
}

std::string comparison_text(std::string_view a, std::string_view b, const PairedComparison& c) {
    const double mean = c.difference.mean;
    if (c.low == c.high) return constant_text(a, b, c.difference);
    const Decimals text(half_width_of(c));
    if (c.found()) {
        return fmt::format("{} is {} {} {} ({})", a, text(std::abs(mean)), side(mean), b,
                           evidence_text(c, mean < 0));
    }
    std::string sentence = fmt::format("no detectable difference between {} and {} ({}, {})", a, b,
                                       text(mean), evidence_text(c, false));
    if (c.detectable) {
        sentence += fmt::format(
            "; at this level a difference of {} would have been detected with {:.0f} % power",
            text(*c.detectable), 100 * power);
    }
    return sentence;
}

std::string equivalence_text(std::string_view a, std::string_view b, double margin,
                             const EquivalenceVerdict& verdict,
                             const PairedComparison& comparison) {
    const std::size_t n = comparison.difference.n;
    const std::string level =
        fmt::format("{:.6g} %{}", 100 * comparison.confidence,
                    comparison.family > 1 ? fmt::format(" for all {}", comparison.family) : "");
    if (verdict.verdict != Equivalence::undecided) {
        return fmt::format("{} is {}within {:.6g} of {} ({}, decided by {} of {} replications)", a,
                           verdict.verdict == Equivalence::within ? "" : "not ", margin, b, level,
                           verdict.decided_at.value_or(n), n);
    }
    const std::string more =
        verdict.needed
            ? fmt::format("about {} would decide, if they are as these are", *verdict.needed)
            : "how many would decide, these do not tell";
    return fmt::format("not decided by {} replications whether {} is within {:.6g} of {} ({}); {}",
                       n, a, margin, b, level, more);
}

}  // namespace rovernet
