// SPDX-License-Identifier: MIT
#include "study/compare.hpp"

#include "models/list.hpp"
#include "sim/error.hpp"
#include "study/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace rovernet {
namespace {

/// The values of each model in the replications that all of them have.
using ValuesOfModels = std::vector<std::vector<double>>;

std::vector<std::string> models_of(const Store& store) {
    std::vector<std::string> models;
    for (const StoredPoint& point : store.points()) {
        const Value* model = point.settings.find("propagation.model");
        if (model && model->string()) models.push_back(*model->string());
    }
    return models;
}

ValuesOfModels paired_values(const Store& store, const std::string& metric) {
    const auto list = answers(store, {.metrics = {metric}});
    ValuesOfModels values(list.size());
    for (const auto& [replication, ignored] : list.front().values) {
        const bool all = std::all_of(list.begin(), list.end(), [r = replication](const Answer& a) {
            return a.values.contains(r);
        });
        for (std::size_t i = 0; all && i < list.size(); ++i) {
            values[i].push_back(list[i].values.at(replication));
        }
    }
    if (values.front().empty()) {
        throw std::invalid_argument(
            fmt::format("there is no replication in which {} has a value for every model", metric));
    }
    return values;
}

/// The last on the ladder.
std::string dearest_of(const std::vector<std::string>& models) {
    std::string dearest = models.front();
    for_each_model([&]<class M>() {
        if (std::find(models.begin(), models.end(), M::name) != models.end()) dearest = M::name;
    });
    return dearest;
}

std::size_t place_of(const std::string& model, const std::vector<std::string>& models) {
    const auto found = std::find(models.begin(), models.end(), model);
    if (found != models.end()) return static_cast<std::size_t>(found - models.begin());
    const std::string near = did_you_mean(model, models);
    throw std::invalid_argument(
        fmt::format("--baseline: \"{}\" is not compared; expected one of {}{}{}", model,
                    fmt::join(models, ", "), near.empty() ? "" : "; ", near));
}

std::vector<double> mean_cpu(const Store& store, std::size_t points) {
    std::vector<double> sum(points), runs(points);
    for (const StoredRun& run : store.runs()) {
        if (!run.error.empty()) continue;
        sum[run.point] += run.measurement.cpu_s;
        ++runs[run.point];
    }
    for (std::size_t i = 0; i < points; ++i) sum[i] /= std::max(runs[i], 1.0);
    return sum;
}

/// Differences to the baseline, with p-values adjusted for their number.
void compare_with_baseline(Comparison& comparison, const ValuesOfModels& values,
                           std::size_t baseline) {
    std::vector<double> p;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == baseline) continue;
        auto& difference = comparison.models[i].difference;
        difference = compare_pairs(values[i], values[baseline], comparison.confidence,
                                   std::max<std::size_t>(values.size() - 1, 1));
        if (difference) p.push_back(difference->p);
    }
    const std::vector<double> adjusted = holm(p);
    auto next = adjusted.begin();
    for (ComparedModel& model : comparison.models) {
        if (!model.difference) continue;
        model.holm_p = *next++;
        model.sentence =
            comparison_text(model.model, comparison.baseline, *model.difference, model.holm_p);
    }
}

}  // namespace

Comparison compare_models(const Store& store, const std::string& metric,
                          const std::string& baseline) {
    const std::vector<std::string> names = models_of(store);
    const ValuesOfModels values = paired_values(store, metric);
    const std::vector<double> cpu = mean_cpu(store, names.size());
    Comparison comparison{.metric = metric,
                          .baseline = baseline.empty() ? dearest_of(names) : baseline,
                          .dearest = dearest_of(names),
                          .confidence = confidence_of(store),
                          .models = {},
                          .pairs = {}};
    const std::vector<double>& dearest = values[place_of(comparison.dearest, names)];
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::vector<double> errors;
        for (std::size_t r = 0; r < dearest.size(); ++r) {
            errors.push_back(std::abs(values[i][r] - dearest[r]));
        }
        ComparedModel model;
        model.model = names[i];
        model.summary = *summary_of(values[i]);
        model.half_width = half_width(model.summary, comparison.confidence);
        model.cpu_s = cpu[i];
        model.error = summary_of(errors)->mean;
        model.error_half_width = half_width(*summary_of(errors), comparison.confidence);
        comparison.models.push_back(std::move(model));
    }
    compare_with_baseline(comparison, values, place_of(comparison.baseline, names));
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (std::size_t j = i + 1; j < names.size(); ++j) {
            const auto pair = compare_pairs(values[i], values[j], comparison.confidence);
            comparison.pairs.push_back(
                {names[i], names[j], pair ? pair->variance_ratio : std::nullopt});
        }
    }
    return comparison;
}

}  // namespace rovernet
