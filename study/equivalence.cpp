// SPDX-License-Identifier: MIT
#include "study/equivalence.hpp"

#include "sim/math.hpp"
#include "study/arguments.hpp"
#include "study/distributions.hpp"
#include "study/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rovernet {
namespace {

constexpr double largest_stake = 0.9;  // of what a gambler may stake
constexpr std::size_t most_searched = 100'000;

void check(double margin, double alpha, std::size_t family) {
    if (!(margin > 0)) {
        throw std::invalid_argument(
            fmt::format("equivalence: the margin must be > 0, got {}", margin));
    }
    if (!(alpha > 0 && alpha < 0.5)) {
        throw std::invalid_argument(
            fmt::format("equivalence: alpha must be above 0 and below 0.5, got {}", alpha));
    }
    if (family == 0) throw std::invalid_argument("equivalence: family must be > 0");
}

EquivalenceVerdict by_betting(std::span<const double> differences, double margin, double range,
                              double alpha, std::size_t family) {
    EquivalenceVerdict result;
    result.method = IntervalMethod::betting;
    if (margin >= range) {  // no difference can be larger
        result.verdict = Equivalence::within;
        result.decided_at = 0;
        return result;
    }
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

EquivalenceVerdict by_student(std::span<const double> differences, double margin, double level) {
    EquivalenceVerdict result;
    result.method = IntervalMethod::t;
    const auto summary = summary_of(differences);
    if (!summary || summary->n < 2 || *summary->standard_deviation == 0) return result;
    const auto verdict_after = [&](std::size_t n) {
        return student_verdict(summary->mean, *summary->standard_deviation, n, margin, level);
    };
    result.verdict = verdict_after(summary->n);
    if (result.verdict != Equivalence::undecided) {
        result.decided_at = summary->n;
        return result;
    }
    std::size_t few = summary->n, many = most_searched;
    if (few >= many || verdict_after(many) == Equivalence::undecided) return result;
    while (many - few > 1) {
        const std::size_t middle = few + (many - few) / 2;
        (verdict_after(middle) == Equivalence::undecided ? few : many) = middle;
    }
    result.needed = many;
    return result;
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
                                  const Bounds& bounds, double alpha, std::size_t family) {
    check(margin, alpha, family);
    check_finite(differences, "equivalence");
    const Bounds range = difference_bounds(bounds);
    if (range.closed() && range.hold(differences)) {
        return by_betting(differences, margin, *range.high, alpha, family);
    }
    return by_student(differences, margin, alpha / static_cast<double>(family));
}

}  // namespace rovernet
