// SPDX-License-Identifier: MIT
#include "study/statistics/equivalence.hpp"

#include "sim/math.hpp"
#include "sim/random.hpp"
#include "study/statistics/arguments.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/interval.hpp"
#include "study/statistics/star_bets.hpp"
#include "study/statistics/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace rovernet {
namespace {

constexpr double largest_stake = 0.9;  // of what a gambler may stake
constexpr std::size_t most_searched = 100'000, most_by_star = 10'000;

void check(double margin, double alpha, std::size_t family) {
    if (!(margin > 0)) {
        throw std::invalid_argument(
            fmt::format("equivalence: the margin must be > 0, got {}", margin));
    }
    if (!(alpha > 0 && alpha < 0.5)) {
        throw std::invalid_argument(
            fmt::format("equivalence: alpha must be above 0 and below 0.5, got {}", alpha));
    }
    if (family == 0)
        throw std::invalid_argument("equivalence: family (the number of comparisons) must be > 0");
}

EquivalenceVerdict by_betting(std::span<const double> differences, double margin, double range,
                              double alpha, std::size_t family) {
    EquivalenceVerdict result;
    EquivalenceTest test(margin / range, alpha, family);
    const std::size_t n = differences.size();
    // The forecast: after the last replication the first one comes again.
    for (std::size_t i = 0; n > 0 && i < std::max(n, most_searched); ++i) {
        test.add(std::clamp(differences[i % n] / range, -1.0, 1.0));
        if (test.verdict() == Equivalence::undecided) continue;
        if (i < n) {
            result.verdict = test.verdict();
            result.decided_at = i + 1;
        } else {
            result.needed = i + 1;
        }
        break;
    }
    return result;
}

/// The verdict of Student's tests on a mean with this deviation after n replications.
Equivalence student_verdict(double mean, double deviation, std::size_t n, double margin,
                            double level) {
    const auto count = static_cast<double>(n);
    const double error = deviation / std::sqrt(count);
    const auto beyond = [&](double one_sided) { return t_critical(count - 1, 2 * one_sided); };
    if (std::abs(mean) + beyond(level) * error < margin) return Equivalence::within;
    if (std::abs(mean) - beyond(level / 2) * error > margin) return Equivalence::outside;
    return Equivalence::undecided;
}

/// Verdict of `verdict_after` n replications, and how many would give one, up to `most`.
EquivalenceVerdict at_one_look(std::size_t n, std::size_t most, const auto& verdict_after) {
    EquivalenceVerdict result;
    result.verdict = verdict_after(n);
    if (result.verdict != Equivalence::undecided) {
        result.decided_at = n;
        return result;
    }
    std::size_t few = n, many = n;
    do {
        few = many;
        many = std::min(2 * many, most);
        if (few >= many) return result;
    } while (verdict_after(many) == Equivalence::undecided);
    while (many - few > 1) {
        const std::size_t middle = few + (many - few) / 2;
        (verdict_after(middle) == Equivalence::undecided ? few : many) = middle;
    }
    result.needed = many;
    return result;
}

/// @param  differences  as shares of their range, -1 to 1
Equivalence star_verdict(std::span<const double> differences, double margin, double level) {
    std::vector<double> up, down;  // from 0 to 1
    for (const double d : differences) {
        up.push_back((1 + d) / 2);
        down.push_back((1 - d) / 2);
    }
    const double over = (1 + margin) / 2, under = (1 - margin) / 2;
    if (star_refutes(down, under, level) && star_refutes(up, under, level)) {
        return Equivalence::within;
    }
    if (star_refutes(up, over, level / 2) || star_refutes(down, over, level / 2)) {
        return Equivalence::outside;
    }
    return Equivalence::undecided;
}

EquivalenceVerdict by_star(std::span<const double> differences, double margin, double range,
                           double level) {
    if (differences.empty()) return {};
    // The forecast: after the last replication the first one comes again.
    return at_one_look(differences.size(), most_by_star, [&](std::size_t n) {
        std::vector<double> shares(n);
        for (std::size_t i = 0; i < n; ++i) {
            shares[i] = std::clamp(differences[i % differences.size()] / range, -1.0, 1.0);
        }
        return star_verdict(shares, margin / range, level);
    });
}

EquivalenceVerdict by_student(std::span<const double> differences, double margin, double level) {
    const auto summary = summary_of(differences);
    if (!summary || summary->n < 2 || *summary->standard_deviation == 0) return {};
    return at_one_look(summary->n, most_searched, [&](std::size_t n) {
        return student_verdict(summary->mean, *summary->standard_deviation, n, margin, level);
    });
}

std::optional<double> decidable_margin(std::span<const double> differences, const Bounds& range,
                                       double level, IntervalMethod method) {
    const auto summary = summary_of(differences);
    if (!summary || summary->n < 2) return std::nullopt;
    const auto interval = interval_of(differences, range, 1 - 2 * level, method);
    if (!interval) return std::nullopt;
    const double error = *summary->standard_deviation / std::sqrt(static_cast<double>(summary->n));
    return interval->half_width() + normal_quantile(0.9) * error;
}

}  // namespace

EquivalenceTest::EquivalenceTest(double margin, double alpha, std::size_t family)
    : margin_(margin),
      log_within_(math::log(static_cast<double>(family) / alpha)),
      log_outside_(math::log(2 * static_cast<double>(family) / alpha)) {
    check(margin, alpha, family);
    if (!(margin < 1)) {
        throw std::invalid_argument(
            fmt::format("equivalence: the margin must be < 1, got {}", margin));
    }
}

void EquivalenceTest::add(double difference) {
    struct Bet {
        double side, edge;
    };
    const std::array<Bet, 4> bets = {{{-1, margin_}, {1, -margin_}, {1, margin_}, {-1, -margin_}}};
    const double mean = sum_ / (n_ + 1), variance = (0.25 + squares_) / (n_ + 1);
    for (std::size_t i = 0; i < bets.size(); ++i) {
        const auto [side, edge] = bets[i];
        const double ahead = mean - edge;
        const double stake = std::clamp(side * ahead / (variance + ahead * ahead), 0.0,
                                        largest_stake / (1 + std::abs(edge)));
        log_wealth_[i] += math::log1p(stake * side * (difference - edge));
        log_most_[i] = std::max(log_most_[i], log_wealth_[i]);
    }
    n_ += 1;
    sum_ += difference;
    const double off = difference - sum_ / (n_ + 1);
    squares_ += off * off;
    if (verdict_ != Equivalence::undecided) return;
    if (std::min(log_most_[not_above], log_most_[not_below]) >= log_within_) {
        verdict_ = Equivalence::within;
    } else if (std::max(log_most_[above], log_most_[beneath]) >= log_outside_) {
        verdict_ = Equivalence::outside;
    }
}

EquivalenceVerdict equivalence_of(std::span<const double> differences, double margin,
                                  const Bounds& bounds, double alpha, std::size_t family,
                                  std::optional<IntervalMethod> wish) {
    check(margin, alpha, family);
    check_finite(differences, "equivalence");
    const Bounds range = difference_bounds(bounds);
    const IntervalMethod method = method_for(differences, range, wish);
    const double level = alpha / static_cast<double>(family);
    EquivalenceVerdict result;
    if (method != IntervalMethod::t && margin >= *range.high) {  // no difference can be larger
        result.verdict = Equivalence::within;
        result.decided_at = 0;
    } else if (method == IntervalMethod::t) {
        result = by_student(differences, margin, level);
    } else if (method == IntervalMethod::star) {
        result = by_star(differences, margin, *range.high, level);
    } else {
        result = by_betting(differences, margin, *range.high, alpha, family);
    }
    result.method = method;
    result.decidable = decidable_margin(differences, range, level, method);
    return result;
}

}  // namespace rovernet
