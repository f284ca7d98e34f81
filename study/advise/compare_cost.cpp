// SPDX-License-Identifier: MIT
#include "study/advise/compare_cost.hpp"

#include "sim/error.hpp"
#include "study/advise/medium_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace rovernet {
namespace {

/// Transmissions of each model's runs, on average.
std::vector<double> mean_transmissions(const Store& store, std::size_t models) {
    std::vector<double> sum(models), runs(models);
    for (const StoredValue& v : store.values("transmissions")) {
        if (v.point >= models || !v.value) continue;
        sum[v.point] += *v.value;
        ++runs[v.point];
    }
    for (std::size_t i = 0; i < models; ++i) sum[i] /= std::max(runs[i], 1.0);
    return sum;
}

/// CPU time [s] of all runs: measuring costs takes no longer.
double cpu_s(const Store& store) {
    double sum = 0;
    for (const StoredRun& run : store.runs()) sum += run.measurement.cpu_s;
    return sum;
}

/// Words on how the costs were measured, and whether they decide what a run costs.
std::string text_of(const MediumCosts& costs, double least_share, double most_share) {
    constexpr double little = 0.1;
    std::string text = fmt::format(
        "CPU/frame: CPU time to find the receivers of one frame (median of {} measurements, each "
        "of {:.3g} s and with the same {} frames)\nfinding the receivers takes {:.2g} to {:.2g} % "
        "of a run's CPU time",
        costs.turns, costs.turn_s, costs.frames, 100 * least_share, 100 * most_share);
    if (most_share < little) {
        text += ": the choice of the model hardly affects the CPU time of a run";
    }
    return text;
}

}  // namespace

void add_costs(Comparison& comparison, Study& study, const Store& store,
               const std::function<bool()>& stopped) {
    std::vector<Scenario> scenarios;
    std::size_t most_detailed = 0;
    for (std::size_t i = 0; i < comparison.models.size(); ++i) {
        scenarios.push_back(study.scenario(i, 0));
        if (comparison.models[i].model == comparison.most_detailed) most_detailed = i;
    }
    MediumRecord record;
    try {
        record = record_medium(scenarios[most_detailed], stopped);
    } catch (const RunError&) {  // that run failed in the study, too, and is told of there
        return;
    }
    const CostTurns turns{.total_s = std::min(CostTurns{}.total_s, cpu_s(store))};
    const MediumCosts costs = measure_medium(record, scenarios, turns, stopped);
    if (costs.models.empty()) return;
    const std::vector<double> transmissions = mean_transmissions(store, scenarios.size());
    double least = 1, most = 0;
    for (std::size_t i = 0; i < scenarios.size(); ++i) {
        ComparedModel& model = comparison.models[i];
        model.cost = costs.models[i];
        if (!(model.cpu_s > 0)) continue;
        const double frames = transmissions[i] * costs.frames_per_transmission;
        model.radio_share = std::min(frames * model.cost->median_s / model.cpu_s, 1.0);
        least = std::min(least, *model.radio_share);
        most = std::max(most, *model.radio_share);
    }
    comparison.cost_text = text_of(costs, least, most);
}

}  // namespace rovernet
