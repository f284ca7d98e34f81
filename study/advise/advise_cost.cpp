// SPDX-License-Identifier: MIT
#include "study/advise/advise_cost.hpp"

#include "mobility/kept_planners.hpp"
#include "study/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace rovernet {
namespace {

/// What runs of some scenarios cost: CPU time and transmissions, medians of a few replications.
struct RunCosts {
    std::vector<std::vector<double>> cpu_s, transmissions;  // by point and replication
    std::uint32_t replications = 0;
    double spent_s = 0;  // CPU time
};

double transmissions_of(const Measurement& measurement) {
    for (const MetricValue& each : measurement.metrics) {
        if (each.name == "transmissions") return each.value.value_or(0);
    }
    return 0;
}

/// Runs the points in alternation, the first one twice: it plans the ways of all.
RunCosts costs_of_runs(const std::vector<std::uint32_t>& points, Study& study,
                       const std::function<bool()>& stopped) {
    constexpr std::uint32_t most = 9;
    constexpr double enough_s = 3;  // CPU time
    RunCosts out{.cpu_s = std::vector<std::vector<double>>(points.size()),
                 .transmissions = std::vector<std::vector<double>>(points.size())};
    KeptPlanners kept;
    for (; out.replications < most && out.spent_s < enough_s && !stopped(); ++out.replications) {
        out.spent_s += measure(study.scenario(points.front(), out.replications), kept).cpu_s;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto run = measure(study.scenario(points[i], out.replications), kept);
            out.cpu_s[i].push_back(run.cpu_s);
            out.transmissions[i].push_back(transmissions_of(run));
            out.spent_s += run.cpu_s;
        }
    }
    return out;
}

double middle_of(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
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

CandidateCost cost_of(double run_s, double transmissions, const MediumCosts& costs,
                      std::size_t path_loss) {
    CandidateCost out{.run_s = run_s, .transmission_s = {}, .low_s = {}, .high_s = {}, .share = {}};
    if (path_loss >= costs.models.size()) return out;
    const MediumCost& medium = costs.models[path_loss];
    out.transmission_s = costs.frames_per_transmission * medium.median_s;
    out.low_s = costs.frames_per_transmission * medium.low_s;
    out.high_s = costs.frames_per_transmission * medium.high_s;
    if (run_s > 0) out.share = std::min(1.0, transmissions * *out.transmission_s / run_s);
    return out;
}

std::string percent_text(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// "the mean delivery_ratio with this model differs by less than 0.02 from the mean with friis"
std::string nearness_text(const Advice& advice, const std::string& reference) {
    if (advice.rule.criterion == ErrorCriterion::mean) {
        return fmt::format(
            "the mean {} with this model differs by less than {:.4g} from the mean with {}",
            advice.metric, advice.rule.tolerance, reference);
    }
    return fmt::format(
        "its {0} differs from the {0} of {1} in the same replication by at most {2:.4g} on average",
        advice.metric, reference, advice.rule.tolerance);
}

/// What the choice saves; empty without costs.
std::string saving_text(const Advice& advice, const CandidateCost& choice) {
    const CandidateCost& reference = advice.reference_cost;
    if (!(reference.run_s > 0) || !(choice.run_s > 0)) return "";
    return fmt::format(
        " A run takes {:.2g} ms of CPU time, instead of {:.2g} ms with the reference.",
        1e3 * choice.run_s, 1e3 * reference.run_s);
}

/// "friis + sinr (about 500 replications would decide)"
std::string open_text(const JudgedCandidate& each) {
    std::vector<std::string> ways;
    if (const auto needed = each.decision.needed()) {
        ways.push_back(fmt::format("about {} replications would decide", *needed));
    }
    if (const auto tolerance = each.decision.deciding_tolerance()) {
        ways.push_back(
            fmt::format("with --tolerance {:.2g} this model would be sufficient", *tolerance));
    }
    return ways.empty() ? each.name : fmt::format("{} ({})", each.name, fmt::join(ways, "; "));
}

constexpr std::string_view to_go_on =
    "To continue the search, give a larger --budget; if --store was given, repeat the same "
    "command.";

/// Candidates that are undecided, cheaper than the choice: they count as insufficient.
std::string undecided_text(const Advice& advice) {
    std::vector<std::string> open;
    for (const JudgedCandidate& each : advice.judged) {
        if (!each.needed || each.decision.verdict() != Equivalence::undecided) continue;
        open.push_back(open_text(each));
    }
    if (open.empty()) return "";
    if (advice.stopped) {
        return fmt::format(
            " These models were undecided when the command was stopped, and count as insufficient "
            "so far: {}. {}",
            fmt::join(open, ", "), to_go_on);
    }
    return fmt::format(
        " These models are undecided after {} replications, and count as insufficient: {}. More "
        "replications (--max-replications) or a longer scenario may decide them.",
        advice.rule.most, fmt::join(open, ", "));
}

}  // namespace

void add_costs(Advice& advice, Study& study, const std::function<bool()>& stopped) {
    const AdviceCandidates& candidates = advice.candidates;
    const std::size_t last = candidates.reference_path_loss();
    std::vector<std::uint32_t> points{*candidates.points[last][candidates.reference_reception()]};
    for (const JudgedCandidate& each : advice.judged) {
        points.push_back(*candidates.points[each.path_loss][each.reception]);
    }
    const RunCosts runs = costs_of_runs(points, study, stopped);
    const MediumCosts costs = costs_of_media(candidates, study, runs.spent_s, stopped);
    if (stopped()) return;
    const auto cost = [&](std::size_t i, std::size_t path_loss) {
        return cost_of(middle_of(runs.cpu_s[i]), middle_of(runs.transmissions[i]), costs,
                       path_loss);
    };
    advice.reference_cost = cost(0, last);
    for (std::size_t i = 0; i < advice.judged.size(); ++i) {
        advice.judged[i].cost = cost(i + 1, advice.judged[i].path_loss);
    }
    if (!costs.models.empty()) {
        advice.cost_text = fmt::format(
            "CPU/transmission: CPU time to find the receivers of one transmission (median of {} "
            "measurements, each of {:.2g} s and with the same {} frames)\nCPU/run: CPU time of a "
            "run without path planning (median of {} replications)\n\"of run\": the share of "
            "\"CPU/run\" that is spent to find receivers",
            costs.turns, costs.turn_s, costs.frames, runs.replications);
    }
}

std::string advice_text(const Advice& advice) {
    const AdviceCandidates& c = advice.candidates;
    const std::string reference = c.name_of(c.reference_path_loss(), c.reference_reception());
    const JudgedCandidate* chosen = advice.chosen();
    if (advice.knows_nothing()) {
        return fmt::format(
            "Interim: nothing is known yet, because no candidate was compared with {}. {}",
            reference, to_go_on);
    }
    const std::string interim = advice.stopped ? "Interim: " : "";
    if (!chosen) {
        return interim +
               fmt::format("Take the reference, {}: no cheaper candidate was found sufficient.{}",
                           reference, undecided_text(advice));
    }
    const std::string sure = fmt::format(
        "{:.4g} % sure{}", 100 * (1 - advice.rule.alpha),
        advice.rule.by_betting() ? ", whatever the distribution" : ", by Student's intervals");
    if (advice.saves_nothing()) {
        return fmt::format(
            "Take the reference, {}. A run takes {:.2g} ms of CPU time, and the radio takes only "
            "{} of this time, so a cheaper model saves almost nothing. {} would be sufficient: {} "
            "({}).{}",
            reference, 1e3 * advice.reference_cost.run_s,
            percent_text(advice.reference_cost.share.value_or(0)), chosen->name,
            nearness_text(advice, reference), sure, undecided_text(advice));
    }
    return interim + fmt::format("Take {}: {} ({}).{}{}", chosen->name,
                                 nearness_text(advice, reference), sure,
                                 saving_text(advice, chosen->cost), undecided_text(advice));
}

}  // namespace rovernet
