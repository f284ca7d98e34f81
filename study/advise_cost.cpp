// SPDX-License-Identifier: MIT
#include "study/advise_cost.hpp"

#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace rovernet {
namespace {

/// Means over the finished runs of a point.
struct RunMeans {
    double cpu_s = 0, transmissions = 0;
};

std::map<std::uint32_t, RunMeans> means_of_runs(const Store& store) {
    std::map<std::uint32_t, RunMeans> means;
    std::map<std::uint32_t, double> runs;
    for (const StoredRun& run : store.runs()) {
        if (!run.error.empty()) continue;
        means[run.point].cpu_s += run.measurement.cpu_s;
        ++runs[run.point];
    }
    for (const StoredValue& v : store.values("transmissions")) {
        means[v.point].transmissions += v.value.value_or(0);
    }
    for (auto& [point, mean] : means) {
        const double n = std::max(runs[point], 1.0);
        mean.cpu_s /= n;
        mean.transmissions /= n;
    }
    return means;
}

/// Costs of the medium by path loss, with the reception that each is judged with.
MediumCosts costs_of_media(const AdviceCandidates& candidates, Study& study, double spent_s,
                           const std::function<bool()>& stopped) {
    std::vector<Scenario> scenarios;
    for (std::size_t p = 0; p < candidates.path_losses.size(); ++p) {
        scenarios.push_back(study.scenario(*candidates.points[p][candidates.reception_of(p)], 0));
    }
    const MediumRecord record = record_medium(scenarios.back(), stopped);
    const CostTurns turns{.total_s = std::min(CostTurns{}.total_s, spent_s)};
    return measure_medium(record, scenarios, turns, stopped);
}

CandidateCost cost_of(const RunMeans& means, const MediumCosts& costs, std::size_t path_loss) {
    CandidateCost out{
        .run_s = means.cpu_s, .transmission_s = {}, .low_s = {}, .high_s = {}, .share = {}};
    if (path_loss >= costs.models.size()) return out;
    const MediumCost& medium = costs.models[path_loss];
    out.transmission_s = costs.frames_per_transmission * medium.median_s;
    out.low_s = costs.frames_per_transmission * medium.low_s;
    out.high_s = costs.frames_per_transmission * medium.high_s;
    if (means.cpu_s > 0) {
        out.share = std::min(1.0, means.transmissions * *out.transmission_s / means.cpu_s);
    }
    return out;
}

std::string percent_text(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// "its mean delivery_ratio is within 0.02 of that of rays + sinr"
std::string nearness_text(const Advice& advice, const std::string& reference) {
    const std::string within =
        fmt::format("within {:.4g} of that of {}", advice.rule.tolerance, reference);
    if (advice.rule.criterion == ErrorCriterion::mean) {
        return fmt::format("its mean {} is {}", advice.metric, within);
    }
    return fmt::format("the {} of a single run is {} on average", advice.metric, within);
}

/// What the choice saves, or that there is nothing to save; empty without costs.
std::string saving_text(const Advice& advice, const CandidateCost& choice) {
    constexpr double little = 0.05, much = 0.9;
    const CandidateCost& reference = advice.reference_cost;
    if (!(reference.run_s > 0) || !(choice.run_s > 0)) return "";
    const double share = reference.share.value_or(1);
    if (share <= little || choice.run_s > much * reference.run_s) {
        return fmt::format(
            " But radio takes {} of a run's CPU time with the reference, and the choice saves next "
            "to nothing of {:.2g} ms: take the reference.",
            percent_text(share), 1e3 * reference.run_s);
    }
    return fmt::format(" A run takes {:.2g} ms of CPU time in place of {:.2g} ms.",
                       1e3 * choice.run_s, 1e3 * reference.run_s);
}

/// Candidates that are undecided, cheaper than the choice: they count as insufficient.
std::string undecided_text(const Advice& advice) {
    std::vector<std::string> names;
    for (const JudgedCandidate& each : advice.judged) {
        if (!each.needed || each.decision.verdict() != Equivalence::undecided) continue;
        const auto needed = each.decision.needed();
        names.push_back(needed ? fmt::format("{} (about {} would decide)", each.name, *needed)
                               : each.name);
    }
    if (names.empty()) return "";
    return fmt::format(
        " Undecided after {} replications, and taken as insufficient: {}. More replications "
        "(--max-replications), a longer scenario or a larger --tolerance decide.",
        advice.rule.most, fmt::join(names, ", "));
}

}  // namespace

void add_costs(Advice& advice, Study& study, const Store& store,
               const std::function<bool()>& stopped) {
    const AdviceCandidates& candidates = advice.candidates;
    double spent_s = 0;
    for (const StoredRun& run : store.runs()) spent_s += run.measurement.cpu_s;
    MediumCosts costs;
    try {
        costs = costs_of_media(candidates, study, spent_s, stopped);
    } catch (const RunError&) {
        return;
    }
    if (stopped()) return;
    auto means = means_of_runs(store);
    const std::size_t last = candidates.reference_path_loss();
    advice.reference_cost =
        cost_of(means[*candidates.points[last][candidates.reference_reception()]], costs, last);
    for (JudgedCandidate& each : advice.judged) {
        const auto point = *candidates.points[each.path_loss][each.reception];
        each.cost = cost_of(means[point], costs, each.path_loss);
        if (!each.helper || !(each.cost.run_s > 0)) continue;
        each.mix = best_mix(each.helper->rho, advice.reference_cost.run_s / each.cost.run_s);
    }
    if (costs.models.empty()) return;
    advice.cost_text = fmt::format(
        "CPU/transmission: what it takes the medium to find who hears it; median of {} turns of "
        "{:.2g} s over the same {} frames; of run: its share of a run's CPU time",
        costs.turns, costs.turn_s, costs.frames);
}

std::string advice_text(const Advice& advice) {
    const AdviceCandidates& c = advice.candidates;
    const std::string reference = c.name_of(c.reference_path_loss(), c.reference_reception());
    const JudgedCandidate* chosen = advice.chosen();
    if (!chosen) {
        return fmt::format("Take the reference, {}: no cheaper candidate was found sufficient.{}",
                           reference, undecided_text(advice));
    }
    return fmt::format(
        "Take {}: {} ({:.4g} % sure{}).{}{}", chosen->name, nearness_text(advice, reference),
        100 * (1 - advice.rule.alpha),
        advice.rule.by_betting() ? ", whatever the distribution" : ", by Student's intervals",
        saving_text(advice, chosen->cost), undecided_text(advice));
}

std::string control_variate_text(const Advice& advice) {
    const JudgedCandidate* best = nullptr;
    const auto worth = [](const JudgedCandidate& each) {
        return each.cost.run_s > 0 ? (each.mix ? each.mix->saving : 0) : std::abs(each.helper->rho);
    };
    for (const JudgedCandidate& each : advice.judged) {
        if (each.helper && (!best || worth(each) > worth(*best))) best = &each;
    }
    if (!best) return "";
    const std::string rho =
        fmt::format("correlation {:.3f}, n = {}", best->helper->rho, best->decision.n());
    if (!(best->cost.run_s > 0)) {
        return fmt::format("Control variate: {} goes best with the reference, run by run ({}).",
                           best->name, rho);
    }
    if (!best->mix) return "Control variate: no candidate would save CPU time for the mean.";
    return fmt::format(
        "Control variate: {:.3g} runs of {} for each of the reference tell the reference's mean "
        "for "
        "{:.2g} times less CPU time ({}).",
        best->mix->ratio, best->name, best->mix->saving, rho);
}

}  // namespace rovernet
