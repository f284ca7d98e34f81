// SPDX-License-Identifier: MIT
#include "study/advise/advise.hpp"

#include "study/cells.hpp"
#include "study/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rovernet {
namespace {

/// A place in the grid of candidates.
struct Combination {
    std::size_t path_loss, reception;
    friend bool operator==(const Combination&, const Combination&) = default;
};

/// Advisor at work: the runs that are there, and what they decided.
class Advisor {
  public:
    Advisor(const AdviceCandidates& candidates, const Store& store, std::string metric,
            const DecisionRule& rule, const MakeRuns& make_runs)
        : candidates_(candidates),
          store_(store),
          metric_(std::move(metric)),
          rule_(rule),
          make_runs_(make_runs) {}

    /// Judges candidates in the order of their detail.
    std::vector<JudgedCandidate> judge(AdviceStep step, const std::vector<Combination>& list);
    /// The cheapest that is sufficient; the reference if none is.
    Combination choice_of(const std::vector<JudgedCandidate>& list) const;
    Combination reference() const {
        return {candidates_.reference_path_loss(), candidates_.reference_reception()};
    }
    std::size_t replications() const { return most_made_; }
    bool stopped() const { return stopped_; }

  private:
    std::uint32_t point_of(const Combination& c) const {
        return *candidates_.points[c.path_loss][c.reception];
    }
    /// Candidates of the next block: wanted, and soon decided.
    std::vector<std::size_t> turn_of(const Ladder& ladder,
                                     const std::vector<std::size_t>& made) const;
    void judge_block(Ladder& ladder, const std::vector<Combination>& list,
                     const std::vector<std::size_t>& turn, std::vector<std::size_t>& made);
    JudgedCandidate judged(const Combination& c, const Ladder& ladder, std::size_t i) const;

    const AdviceCandidates& candidates_;
    const Store& store_;
    std::string metric_;
    DecisionRule rule_;
    const MakeRuns& make_runs_;
    std::size_t most_made_ = 0;  // of the reference
    bool stopped_ = false;
};

std::vector<std::size_t> Advisor::turn_of(const Ladder& ladder,
                                          const std::vector<std::size_t>& made) const {
    constexpr std::size_t enough_to_tell = 100, never = SIZE_MAX, ratio = 4;
    std::vector<std::size_t> forecast(ladder.size(), never), turn;
    for (std::size_t i = 0; i < ladder.size(); ++i) {
        if (!ladder.wants(i) || made[i] >= rule_.most) continue;
        if (made[i] < enough_to_tell || !rule_.by_betting()) {
            forecast[i] = made[i];  // in every turn
        } else if (const auto needed = ladder[i].needed(); needed && *needed <= rule_.most) {
            forecast[i] = *needed;
        }
    }
    const std::size_t least = std::ranges::min(forecast);
    for (std::size_t i = 0; i < forecast.size(); ++i) {
        if (forecast[i] == never) continue;
        if (made[i] < enough_to_tell || forecast[i] / ratio <= least) turn.push_back(i);
    }
    return turn;
}

void Advisor::judge_block(Ladder& ladder, const std::vector<Combination>& list,
                          const std::vector<std::size_t>& turn, std::vector<std::size_t>& made) {
    std::vector<std::uint32_t> asked(candidates_.family() + 1);
    std::vector<std::size_t> from = made;
    std::uint32_t& of_reference = asked[point_of(reference())];
    for (const std::size_t i : turn) {
        made[i] = next_block(made[i], rule_.most);
        asked[point_of(list[i])] = static_cast<std::uint32_t>(made[i]);
        of_reference = std::max(of_reference, static_cast<std::uint32_t>(made[i]));
    }
    if (!make_runs_(asked)) {
        stopped_ = true;
        return;
    }
    most_made_ = std::max(most_made_, std::size_t{of_reference});
    ValuesOfPoints values = values_of_points(store_, metric_);
    const auto value = [&](const Combination& c, std::size_t r) {
        const auto& of_point = values[point_of(c)];
        return r < of_point.size() ? of_point[r] : std::nullopt;
    };
    for (const std::size_t i : turn) {
        for (std::size_t r = from[i]; r < made[i]; ++r) {
            const auto candidate = value(list[i], r), of_ref = value(reference(), r);
            if (candidate && of_ref) ladder.add(i, *candidate, *of_ref);
        }
    }
}

JudgedCandidate Advisor::judged(const Combination& c, const Ladder& ladder, std::size_t i) const {
    JudgedCandidate out{.step = {},
                        .path_loss = c.path_loss,
                        .reception = c.reception,
                        .name = candidates_.name_of(c.path_loss, c.reception),
                        .decision = ladder[i],
                        .needed = i <= ladder.choice().value_or(ladder.size()),
                        .bias_interval = {},
                        .run_error_interval = {},
                        .cost = {}};
    const CandidateDecision& decision = out.decision;
    const std::vector<double> differences = decision.differences();
    if (differences.empty()) return out;
    std::vector<double> sizes;
    for (const double d : differences) sizes.push_back(std::abs(d));
    out.bias = summary_of(differences)->mean;
    out.run_error = summary_of(sizes)->mean;
    const double confidence = 1 - rule_.alpha;
    // As many replications as the verdicts took: only betting allows that.
    constexpr auto betting = IntervalMethod::betting;
    out.bias_interval =
        interval_of(differences, difference_bounds(rule_.bounds), confidence, betting);
    const Bounds size_bounds =
        rule_.by_betting() ? Bounds{0.0, difference_bounds(rule_.bounds).high} : Bounds{};
    out.run_error_interval = interval_of(sizes, size_bounds, confidence, betting);
    return out;
}

std::vector<JudgedCandidate> Advisor::judge(AdviceStep step, const std::vector<Combination>& list) {
    Ladder ladder(list.size(), rule_);
    std::vector<std::size_t> made(list.size());
    while (!stopped_ && !list.empty()) {
        const std::vector<std::size_t> turn = turn_of(ladder, made);
        if (turn.empty()) break;
        judge_block(ladder, list, turn, made);
    }
    std::vector<JudgedCandidate> out;
    for (std::size_t i = 0; i < list.size(); ++i) {
        out.push_back(judged(list[i], ladder, i));
        out.back().step = step;
    }
    return out;
}

Combination Advisor::choice_of(const std::vector<JudgedCandidate>& list) const {
    for (const JudgedCandidate& each : list) {
        if (each.decision.verdict() == Equivalence::within) {
            return {each.path_loss, each.reception};
        }
    }
    return reference();
}

}  // namespace

std::size_t next_block(std::size_t n, std::size_t most) {
    constexpr std::size_t least = 10, share = 4;
    return std::min(most, n + std::max(least, n / share));
}

Advice advise(const AdviceCandidates& candidates, const Store& store, const std::string& metric,
              const DecisionRule& rule, const MakeRuns& make_runs) {
    Advisor advisor(candidates, store, metric, rule, make_runs);
    const Combination reference = advisor.reference();
    std::vector<Combination> path_losses, receptions;
    for (std::size_t p = 0; p < reference.path_loss; ++p) {
        path_losses.push_back({p, candidates.reception_of(p)});
    }
    for (std::size_t r = 0; r < reference.reception; ++r) {
        if (candidates.points[reference.path_loss][r]) {
            receptions.push_back({reference.path_loss, r});
        }
    }
    const auto of_path_losses = advisor.judge(AdviceStep::path_loss, path_losses);
    const auto of_receptions = advisor.judge(AdviceStep::reception, receptions);
    const Combination by_path_loss = advisor.choice_of(of_path_losses);
    const Combination both{
        by_path_loss.path_loss,
        std::min(by_path_loss.reception, advisor.choice_of(of_receptions).reception)};
    Advice out{.metric = metric,
               .rule = rule,
               .candidates = candidates,
               .judged = of_path_losses,
               .path_loss = both.path_loss,
               .reception = both.reception,
               .reference_cost = {}};
    out.judged.insert(out.judged.end(), of_receptions.begin(), of_receptions.end());
    if (both != reference && !out.chosen()) {
        const bool runs = candidates.points[both.path_loss][both.reception].has_value();
        const auto of_both =
            advisor.judge(AdviceStep::both, runs ? std::vector{both} : std::vector<Combination>{});
        if (advisor.choice_of(of_both) == reference) out.reception = by_path_loss.reception;
        out.judged.insert(out.judged.end(), of_both.begin(), of_both.end());
    }
    out.replications = advisor.replications();
    out.stopped = advisor.stopped();
    return out;
}

bool Advice::knows_nothing() const {
    return stopped && std::ranges::all_of(judged, [](const JudgedCandidate& each) {
               return each.decision.n() == 0;
           });
}

const JudgedCandidate* Advice::chosen() const {
    for (const JudgedCandidate& each : judged) {
        if (each.path_loss == path_loss && each.reception == reception) return &each;
    }
    return nullptr;
}

bool Advice::saves_nothing() const {
    constexpr double little = 0.05, most = 0.9;
    const JudgedCandidate* choice = chosen();
    if (!choice || !(reference_cost.run_s > 0)) return false;
    return reference_cost.share.value_or(1) <= little ||
           choice->cost.run_s > most * reference_cost.run_s;
}

}  // namespace rovernet
