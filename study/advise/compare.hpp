// SPDX-License-Identifier: MIT
#pragma once

#include "study/statistics/comparison.hpp"
#include "study/statistics/equivalence.hpp"
#include "study/statistics/interval.hpp"
#include "study/advise/medium_cost.hpp"
#include "study/results.hpp"
#include "study/store.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// Propagation model, or value of another key, among those that are compared over common random
/// numbers.
struct ComparedModel {
    std::string model;                  ///< "friis", "ttl=4"
    Answer answer;                      ///< the metric of all its replications, as results have it
    double cpu_s = 0;                   ///< [s] mean per run
    std::optional<MediumCost> cost;     ///< cost of the medium; see add_costs()
    std::optional<double> radio_share;  ///< share of that cost in the runs' CPU time [-], about
    /// Mean distance to the most detailed model's value over the replications in which both have
    /// one, in the metric's unit, its interval (none for the most detailed model, whose error is 0
    /// by definition), and how many replications these are.
    std::optional<double> error;
    std::optional<MeanInterval> error_interval;
    std::size_t error_n = 0;
    /// Difference of this model to the baseline, over the replications in which both have a value;
    /// nothing for the baseline itself or fewer than 2 of them.
    std::optional<PairedComparison> difference;
    Gaps unpaired;  ///< replications that are not in the difference, as one of both lacks them
    std::string sentence;  ///< the difference in words; empty without one
    /// Whether the difference lies within the margin, if one was asked for; and in words.
    std::optional<EquivalenceVerdict> equivalence;
    std::string equivalence_sentence;
};

/// Gain by common random numbers between two models.
struct PairedVariance {
    std::string a, b;
    std::optional<double> ratio;  ///< see paired_variance_ratio()
};

struct Comparison {
    std::string metric, baseline;
    std::string most_detailed;  ///< most detailed model; of another key the first value
    std::string path = {};      ///< key that varies
    double confidence = 0.95;
    std::optional<double> margin;       ///< margin, in the metric's unit
    std::vector<ComparedModel> models;  ///< models, as in the study
    RunCounts runs;                     ///< runs of all models
    std::string held = {};  ///< other keys that the study varies, at the values that were run
    std::vector<PairedVariance> pairs;
    std::string cost_text = {};  ///< words on how costs were measured, and whether they matter
};

/// The place of a baseline among the models that are compared.
/// @throws std::invalid_argument if it is none of them
std::size_t place_of(const std::string& baseline, const std::vector<std::string>& models);

/// Name of what is compared at a value of a key: "friis" of propagation.model, else "ttl=4".
std::string compared_name(const std::string& path, const Value& value);

/// Compares the models of a store whose study varies propagation.model alone, or the values of the
/// one key that it varies, each pair over the replications in which both have a value. The most
/// detailed model is the last of them in the list of `rovernet models`: what is said of errors does
/// not depend on how fast a machine is. Of another key errors are distances to the first value.
/// @param  baseline  one of the names; the most detailed one if empty
/// @param  margin    > 0, in the metric's unit: how far from the baseline a model may lie and still
///                   count as good; if not given, this is not judged
/// @throws std::invalid_argument if the metric or the baseline is unknown
Comparison compare_models(const Store& store, const std::string& metric,
                          const std::string& baseline, std::optional<double> margin = {});

}  // namespace rovernet
