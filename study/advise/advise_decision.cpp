// SPDX-License-Identifier: MIT
#include "study/advise/advise_decision.hpp"

#include "sim/math.hpp"
#include "study/statistics/distributions.hpp"
#include "study/statistics/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace rovernet {
namespace {

constexpr std::size_t first_look = 10;

/// Numbers of pairs at which Student's interval is looked at.
std::vector<std::size_t> looks_until(std::size_t most) {
    std::vector<std::size_t> looks;
    for (std::size_t n = first_look; n < most; n *= 2) looks.push_back(n);
    looks.push_back(most);
    return looks;
}

double range_of(const Bounds& bounds) { return *bounds.high - *bounds.low; }

}  // namespace

CandidateDecision::CandidateDecision(const DecisionRule& rule) : rule_(rule) {
    if (!(rule.tolerance > 0)) {
        throw std::invalid_argument(
            fmt::format("decision: the tolerance must be > 0, got {}", rule.tolerance));
    }
    if (rule.by_betting()) {
        test_.emplace(rule.tolerance / range_of(rule.bounds), rule.alpha, rule.family);
    } else {
        looks_ = looks_until(rule.most);
    }
}

double CandidateDecision::error_of(double candidate, double reference) const {
    if (rule_.by_betting()) {
        candidate = std::clamp(candidate, *rule_.bounds.low, *rule_.bounds.high);
        reference = std::clamp(reference, *rule_.bounds.low, *rule_.bounds.high);
    }
    const double difference = candidate - reference;
    return rule_.criterion == ErrorCriterion::run ? std::abs(difference) : difference;
}

void CandidateDecision::add(double candidate, double reference) {
    candidate_.push_back(candidate);
    reference_.push_back(reference);
    if (verdict_ != Equivalence::undecided) return;
    const double error = error_of(candidate, reference);
    rule_.by_betting() ? bet(error) : look(error);
    if (verdict_ != Equivalence::undecided) decided_at_ = n();
}

void CandidateDecision::bet(double error) {
    test_->add(error / range_of(rule_.bounds));
    verdict_ = test_->verdict();
    const bool one_sided = rule_.criterion == ErrorCriterion::run;
    const double enough = math::log(static_cast<double>(rule_.family) / rule_.alpha);
    if (verdict_ == Equivalence::undecided && one_sided &&
        test_->log_wealth(EquivalenceTest::above) >= enough) {
        verdict_ = Equivalence::outside;
    }
}

void CandidateDecision::look(double error) {
    errors_.push_back(error);
    if (std::find(looks_.begin(), looks_.end(), n()) == looks_.end()) return;
    const Summary summary = *summary_of(errors_);
    const double deviation = summary.standard_deviation.value_or(0);
    if (deviation == 0) return;
    const auto count = static_cast<double>(n());
    const double level = rule_.alpha / static_cast<double>(rule_.family * looks_.size());
    const double half_width = t_critical(count - 1, level) * deviation / std::sqrt(count);
    if (std::abs(summary.mean) + half_width < rule_.tolerance) verdict_ = Equivalence::within;
    if (std::abs(summary.mean) - half_width > rule_.tolerance) verdict_ = Equivalence::outside;
}

std::vector<double> CandidateDecision::differences() const {
    std::vector<double> out(n());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = candidate_[i] - reference_[i];
    return out;
}

std::optional<std::size_t> CandidateDecision::needed() const {
    constexpr std::size_t most_searched = 100'000;
    if (verdict_ != Equivalence::undecided || !test_ || n() == 0) return std::nullopt;
    CandidateDecision forecast = *this;
    while (forecast.verdict_ == Equivalence::undecided && forecast.n() < most_searched) {
        const std::size_t again = forecast.n() % n();
        forecast.add(candidate_[again], reference_[again]);
    }
    return forecast.decided_at_;
}

Equivalence CandidateDecision::verdict_with(double tolerance) const {
    DecisionRule rule = rule_;
    rule.tolerance = tolerance;
    CandidateDecision other(rule);
    for (std::size_t i = 0; i < n(); ++i) other.add(candidate_[i], reference_[i]);
    return other.verdict_;
}

std::optional<double> CandidateDecision::deciding_tolerance() const {
    if (verdict_ != Equivalence::undecided || n() == 0) return std::nullopt;
    constexpr double step = 1.02;  // tolerances of two digits are no closer
    const double range =
        rule_.by_betting() ? range_of(rule_.bounds) : std::numeric_limits<double>::infinity();
    double last = rule_.tolerance;
    for (double t = rule_.tolerance * step; t < range && t < 1e3 * rule_.tolerance; t *= step) {
        const double rounded = std::stod(fmt::format("{:.1e}", t));
        if (rounded <= last || rounded >= range) continue;
        last = rounded;
        if (verdict_with(rounded) == Equivalence::within) return rounded;
    }
    return std::nullopt;
}

Ladder::Ladder(std::size_t candidates, const DecisionRule& rule) {
    for (std::size_t i = 0; i < candidates; ++i) decisions_.emplace_back(rule);
}

std::optional<std::size_t> Ladder::choice() const {
    for (std::size_t i = 0; i < size(); ++i) {
        if (decisions_[i].verdict() == Equivalence::within) return i;
    }
    return std::nullopt;
}

bool Ladder::wants(std::size_t i) const {
    return decisions_[i].verdict() == Equivalence::undecided && i < choice().value_or(size());
}

bool Ladder::decided() const {
    for (std::size_t i = 0; i < size(); ++i) {
        if (wants(i)) return false;
    }
    return true;
}

}  // namespace rovernet
