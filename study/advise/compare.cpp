// SPDX-License-Identifier: MIT
#include "study/advise/compare.hpp"

#include "models/propagation/list.hpp"
#include "scenario/document/toml.hpp"
#include "sim/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <stdexcept>

namespace rovernet {
namespace {

/// The one key that varies, and its value.
const Entry& setting_of(const Answer& answer) {
    if (answer.settings.entries.size() == 1) return answer.settings.entries.front();
    throw std::invalid_argument("compare: expected a store whose study varies exactly one key");
}

/// The values of two models in the replications in which both have one.
struct Pairs {
    std::vector<double> a, b;
};

Pairs pairs_of(const Answer& a, const Answer& b) {
    Pairs pairs;
    for (const auto& [replication, value] : a.values) {
        const auto other = b.values.find(replication);
        if (other == b.values.end()) continue;
        pairs.a.push_back(value);
        pairs.b.push_back(other->second);
    }
    return pairs;
}

/// Last of these models in the list of all: the most detailed one.
std::string most_detailed_of(const std::vector<std::string>& models) {
    std::string most_detailed = models.front();
    for_each_model([&]<class M>() {
        if (std::find(models.begin(), models.end(), M::name) != models.end())
            most_detailed = M::name;
    });
    return most_detailed;
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

/// Reason why replications give no pair for two models: a run failed, is missing, or has no value.
Gaps unpaired(const Inventory& inventory, const Answer& a, const Answer& b, std::uint32_t point_a,
              std::uint32_t point_b) {
    Gaps gaps;
    const auto &of_a = inventory.at(point_a), &of_b = inventory.at(point_b);
    const auto is = [](const std::vector<RunState>& states, std::size_t r, RunState state) {
        return (r < states.size() ? states[r] : RunState::missing) == state;
    };
    for (std::uint32_t r = 0; r < std::max(of_a.size(), of_b.size()); ++r) {
        if (a.values.contains(r) && b.values.contains(r)) continue;
        if (is(of_a, r, RunState::failed) || is(of_b, r, RunState::failed)) {
            ++gaps.failed;
        } else if (is(of_a, r, RunState::missing) || is(of_b, r, RunState::missing)) {
            ++gaps.missing;
        } else {
            ++gaps.undefined;
        }
    }
    return gaps;
}

void add_error(ComparedModel& model, const Answer& most_detailed, const std::string& metric,
               double confidence, std::optional<IntervalMethod> wish) {
    const Pairs pairs = pairs_of(model.answer, most_detailed);
    std::vector<double> distances;
    for (std::size_t i = 0; i < pairs.a.size(); ++i) {
        distances.push_back(std::abs(pairs.a[i] - pairs.b[i]));
    }
    model.error_n = distances.size();
    const auto summary = summary_of(distances);
    if (!summary) return;
    model.error = summary->mean;
    model.error_interval = interval_of(distances, bounds_of(metric), confidence, wish);
}

/// Whether a model has a difference to the baseline: at least two pairs.
bool has_difference(const ComparedModel& model, const ComparedModel& baseline) {
    return &model != &baseline && pairs_of(model.answer, baseline.answer).a.size() >= 2;
}

/// Differences to the baseline, with intervals that hold together with those of the family.
void compare_with_baseline(Comparison& comparison, const ComparedModel& baseline,
                           std::size_t family, std::optional<IntervalMethod> wish) {
    const Bounds bounds = bounds_of(comparison.metric);
    for (ComparedModel& m : comparison.models) {
        if (!has_difference(m, baseline)) continue;
        const Pairs pairs = pairs_of(m.answer, baseline.answer);
        m.difference = compare_pairs(pairs.a, pairs.b, bounds, comparison.confidence, family, wish);
        m.sentence = comparison_text(m.model, comparison.baseline, *m.difference);
        if (!comparison.margin) continue;
        std::vector<double> differences(pairs.a.size());
        std::ranges::transform(pairs.a, pairs.b, differences.begin(), std::minus<>{});
        m.equivalence = equivalence_of(differences, *comparison.margin, bounds,
                                       1 - comparison.confidence, family, wish);
        m.equivalence_sentence = equivalence_text(m.model, comparison.baseline, *comparison.margin,
                                                  *m.equivalence, *m.difference);
    }
}

/// Comparison without differences to the baseline, whose family is not known yet.
Comparison comparison_of(const Store& store, const std::string& metric, const std::string& baseline,
                         std::optional<double> margin) {
    Answers all = answers(store, {.metrics = {metric}});
    const Inventory inventory = inventory_of(store);
    const std::vector<double> cpu = mean_cpu(store, all.list.size());
    std::vector<std::string> names;
    for (const Answer& answer : all.list) {
        names.push_back(compared_name(setting_of(answer).key, setting_of(answer).value));
    }
    Comparison comparison{.metric = metric,
                          .baseline = baseline.empty() ? most_detailed_of(names) : baseline,
                          .most_detailed = most_detailed_of(names),
                          .path = setting_of(all.list.front()).key,
                          .confidence = confidence_of(store),
                          .margin = margin,
                          .models = {},
                          .runs = all.runs,
                          .pairs = {}};
    const std::size_t base = place_of(comparison.baseline, names);
    const Answer& most_detailed = all.list[place_of(comparison.most_detailed, names)];
    for (std::size_t i = 0; i < names.size(); ++i) {
        ComparedModel model;
        model.model = names[i];
        model.answer = all.list[i];
        model.cpu_s = cpu[i];
        model.unpaired = unpaired(inventory, all.list[i], all.list[base],
                                  static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(base));
        add_error(model, most_detailed, metric, comparison.confidence, interval_method_of(store));
        if (model.model == comparison.most_detailed)
            model.error_interval.reset();  // 0 by definition
        comparison.models.push_back(std::move(model));
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        for (std::size_t j = i + 1; j < names.size(); ++j) {
            const Pairs pairs = pairs_of(all.list[i], all.list[j]);
            comparison.pairs.push_back(
                {names[i], names[j], paired_variance_ratio(pairs.a, pairs.b)});
        }
    }
    return comparison;
}

/// The model that the others are compared with.
const ComparedModel& baseline_in(const Comparison& comparison) {
    return *std::ranges::find(comparison.models, comparison.baseline, &ComparedModel::model);
}

}  // namespace

std::string compared_name(const std::string& path, const Value& value) {
    if (path == model_path || path == protocol_path) return plain_text(value);
    return fmt::format("{}={}", path.substr(path.rfind('.') + 1), plain_text(value));
}

std::size_t place_of(const std::string& model, const std::vector<std::string>& models) {
    const auto found = std::find(models.begin(), models.end(), model);
    if (found != models.end()) return static_cast<std::size_t>(found - models.begin());
    const std::string near = did_you_mean(model, models);
    throw std::invalid_argument(
        fmt::format("--baseline: \"{}\" is not among the compared values; expected one of {}{}{}",
                    model, fmt::join(models, ", "), near.empty() ? "" : "; ", near));
}

std::vector<Comparison> comparisons_of(const Store& store, const std::vector<std::string>& metrics,
                                       const std::string& baseline, std::optional<double> margin) {
    std::vector<Comparison> all;
    std::size_t family = 0;
    for (const std::string& metric : metrics) {
        const Comparison& made = all.emplace_back(comparison_of(store, metric, baseline, margin));
        const ComparedModel& base = baseline_in(made);
        family += static_cast<std::size_t>(std::ranges::count_if(
            made.models, [&](const ComparedModel& m) { return has_difference(m, base); }));
    }
    for (Comparison& each : all) {
        compare_with_baseline(each, baseline_in(each), family, interval_method_of(store));
    }
    return all;
}

Comparison compare_models(const Store& store, const std::string& metric,
                          const std::string& baseline, std::optional<double> margin) {
    return comparisons_of(store, std::vector{metric}, baseline, margin).front();
}

}  // namespace rovernet
