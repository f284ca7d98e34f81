// SPDX-License-Identifier: MIT
#include "study/statistics/comparison.hpp"

#include "sim/math.hpp"
#include "sim/random.hpp"
#include "study/statistics/arguments.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/interval.hpp"
#include "study/statistics/scaled_values.hpp"
#include "study/statistics/star_bets.hpp"

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
        throw std::invalid_argument(fmt::format(
            "{}: expected pairs of values, but one list has {} and the other list has {} values",
            owner, a.size(), b.size()));
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

/// Level by betting: the least at which the interval leaves 0 out, between 1e-6 and 1.
double betting_p(std::span<const double> differences, const Bounds& bounds) {
    const auto leaves_out = [&](double level) {
        const auto interval = interval_of(differences, bounds, 1 - level, IntervalMethod::betting);
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

/// The level by STaR-Bets, see compare_pairs(). @param  found  the interval at `level` leaves 0 out
double star_p(std::span<const double> differences, const Bounds& limits, double level, bool found) {
    const ScaledValues x = scaled_values(differences, limits, 1 - level, "compare_pairs");
    const auto& side = x.mean() > 0.5 ? x.values : x.mirrored;
    const double step = std::sqrt(std::sqrt(0.5));
    constexpr double least = 1e-6;
    const double end = found ? least : level;
    double p = found ? level : 1;
    while (p * step > end && star_refutes(side, 0.5, p * step / 2)) p *= step;
    return p;
}

/// Level of the two-sided sign test.
double sign_level(std::size_t above, std::size_t below) {
    return std::min(1.0, 2 * binomial_at_most(std::min(above, below), above + below, 0.5));
}

bool is_above(double difference) { return difference > 0; }
bool is_below(double difference) { return difference < 0; }

double half_width_of(const PairedComparison& c) { return (c.high - c.low) / 2; }

bool leaves_0_out(const PairedComparison& c) { return c.low > 0 || c.high < 0; }

/// p of one comparison alone, by its method.
double level_of(std::span<const double> differences, const Bounds& limits, double level,
                const PairedComparison& c) {
    switch (c.method) {
        case IntervalMethod::t: return p_value(c.difference);
        case IntervalMethod::betting: return betting_p(differences, limits);
        default: return star_p(differences, limits, level, leaves_0_out(c));
    }
}

/// Mean at which such differences, shifted to it, refute 0 by STaR-Bets.
double refuting_mean(std::span<const double> differences, const Bounds& limits, double level) {
    constexpr int bisections = 12;
    const double mean = summary_of(differences)->mean;
    double low = 0, high = *limits.high;
    for (int i = 0; i < bisections; ++i) {
        const double middle = (low + high) / 2;
        std::vector<double> shares;  // from 0 to 1, 1/2 is no difference
        for (const double d : differences) {
            shares.push_back(std::clamp(0.5 + (d - mean + middle) / (2 * *limits.high), 0.0, 1.0));
        }
        (star_refutes(shares, 0.5, level / 2) ? high : low) = middle;
    }
    return high;
}

std::optional<double> detectable(const Summary& difference, std::span<const double> differences,
                                 const Bounds& limits, double level, const PairedComparison& c) {
    const double error = standard_error(difference);
    const double beyond = normal_quantile(power) * error;
    if (c.method == IntervalMethod::betting) return half_width_of(c) + beyond;
    if (c.method == IntervalMethod::star) return refuting_mean(differences, limits, level) + beyond;
    const auto shift = t_shift(degrees(difference), level, power);
    if (!shift) return std::nullopt;
    return *shift * error;
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

std::string p_text(double p) { return p < 0.001 ? "< 0.001" : fmt::format("= {:.3f}", p); }

/// "95 % 0.180 to 0.246, n = 30, p < 0.001, by STaR-Bets"; with the sign of everything changed if
/// `turned`.
std::string evidence_text(const PairedComparison& c, bool turned) {
    const Decimals text(half_width_of(c));
    return fmt::format("{:.6g} % interval{} {} to {}, n = {}, p {}, {}", 100 * c.confidence,
                       c.family > 1 ? fmt::format(" for all {} comparisons:", c.family) : "",
                       text(turned ? -c.high : c.low), text(turned ? -c.low : c.high),
                       c.difference.n, p_text(c.p), words_of(c.method));
}

/// "; differences below 0.021 cannot be detected at n = 30", of a difference that was found
/// "; a difference of 0.021 is found in 80 % of studies with 30 replications".
std::string power_text(const PairedComparison& c) {
    if (!c.detectable) return "";
    const bool beyond_bounds = c.method != IntervalMethod::t && *c.detectable >= 1;
    if (beyond_bounds)
        return fmt::format("; no difference can be detected with {} replications", c.difference.n);
    if (c.found()) {
        return fmt::format(
            "; a difference of {} is found in {:.0f} % of studies with {} replications",
            Decimals(half_width_of(c))(*c.detectable), 100 * power, c.difference.n);
    }
    return fmt::format("; differences below {} cannot be detected with {} replications",
                       Decimals(half_width_of(c))(*c.detectable), c.difference.n);
}

/// Comparison whose signs tell what its mean does not.
std::string direction_text(std::string_view a, std::string_view b, const PairedComparison& c) {
    const bool up = c.above > c.below;
    return fmt::format(
        "{} is {} {} in {} of {} replications and {} in {} (p {}, sign test); no difference of the "
        "means is detected ({}, {}){}",
        a, up ? "above" : "below", b, std::max(c.above, c.below), c.difference.n,
        up ? "below" : "above", std::min(c.above, c.below), p_text(*c.sign_p),
        Decimals(half_width_of(c))(c.difference.mean), evidence_text(c, false), power_text(c));
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
    if (family == 0)
        throw std::invalid_argument(
            "compare_pairs: family (the number of comparisons) must be > 0");
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
                       .detectable = {},
                       .sign_p = {}};
    const auto count = static_cast<double>(family);
    c.p = std::min(1.0, count * level_of(differences, limits, level, c));
    if (c.method == IntervalMethod::star && leaves_0_out(c)) c.p = std::min(c.p, 1 - confidence);
    c.detectable = detectable(difference, differences, limits, level, c);
    c.above = static_cast<std::size_t>(std::ranges::count_if(differences, is_above));
    c.below = static_cast<std::size_t>(std::ranges::count_if(differences, is_below));
    if (c.method != IntervalMethod::betting) {
        c.sign_p = std::min(1.0, count * sign_level(c.above, c.below));
    }
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
        return fmt::format("{} is {} {} {} ({}){}", a, text(std::abs(mean)), side(mean), b,
                           evidence_text(c, mean < 0), power_text(c));
    }
    if (c.direction_found()) return direction_text(a, b, c);
    return fmt::format("no detectable difference between {} and {} ({}, {}){}", a, b, text(mean),
                       evidence_text(c, false), power_text(c));
}

std::string equivalence_text(std::string_view a, std::string_view b, double margin,
                             const EquivalenceVerdict& verdict,
                             const PairedComparison& comparison) {
    const std::size_t n = comparison.difference.n;
    const std::string level = fmt::format(
        "{:.6g} %{}, {}", 100 * comparison.confidence,
        comparison.family > 1 ? fmt::format(" for all {} comparisons", comparison.family) : "",
        words_of(verdict.method));
    if (verdict.verdict != Equivalence::undecided) {
        const bool tells = verdict.decidable && margin >= *verdict.decidable;
        const std::string smallest =
            tells ? fmt::format("; margins below {:.2g} need more than {} replications",
                                *verdict.decidable, n)
                  : "";
        return fmt::format("{} is {}within {:.6g} of {} ({}, decided by {} of {} replications){}",
                           a, verdict.verdict == Equivalence::within ? "" : "not ", margin, b,
                           level, verdict.decided_at.value_or(n), n, smallest);
    }
    const std::string more =
        verdict.needed
            ? fmt::format("about {} replications like these would be enough for a decision",
                          *verdict.needed)
            : "the number of replications that a decision needs cannot be estimated";
    return fmt::format("{} replications do not decide whether {} is within {:.6g} of {} ({}); {}",
                       n, a, margin, b, level, more);
}

}  // namespace rovernet
