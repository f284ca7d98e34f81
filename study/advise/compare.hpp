// SPDX-License-Identifier: MIT
#pragma once

#include "study/advise/medium_cost.hpp"
#include "study/results.hpp"
#include "study/statistics/comparison.hpp"
#include "study/statistics/equivalence.hpp"
#include "study/statistics/interval.hpp"
#include "study/store.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Compared variant of a scenario: a propagation model, or a value of any other varied key. All
/// variants use common random numbers.
struct ComparedModel {
    std::string model;  ///< name of the model or value: "friis", "ttl=4"
    Answer answer;      ///< mean of the metric over all replications of this model, see answers()
    double cpu_s = 0;   ///< mean CPU time of a run [s]
    std::optional<MediumCost> cost;  ///< CPU cost of the medium; see add_costs()
    /// Approximate share of the medium's CPU time in the CPU time of the runs [-].
    std::optional<double> radio_share;
    /// Mean absolute difference to the most detailed model, in the metric's unit, over replications
    /// in which both models have a value; 0 for the most detailed model itself.
    std::optional<double> error;
    /// Confidence interval of `error`, see interval_of(); none for the most detailed model.
    std::optional<MeanInterval> error_interval;
    /// Number of replications that contribute to the mean `error`.
    std::size_t error_n = 0;
    /// Difference of this model to the baseline model, over replications in which both models have
    /// a value. None for the baseline itself, or for fewer than 2 replications.
    std::optional<PairedComparison> difference;
    Gaps unpaired;         ///< number of replications in which a model has no value, by reason
    std::string sentence;  ///< `difference` as a sentence; empty without a difference
    /// Verdict whether the difference to the baseline lies within Comparison::margin; none without
    /// a margin or without a difference.
    std::optional<EquivalenceVerdict> equivalence;
    std::string equivalence_sentence;  ///< `equivalence` as a sentence; empty without a verdict
};

/// Reduction of the variance of the difference of two models by common random numbers.
struct PairedVariance {
    std::string a, b;
    std::optional<double> ratio;  ///< variance ratio [-], see paired_variance_ratio()
};

struct Comparison {
    std::string metric, baseline;
    std::string most_detailed;  ///< most detailed model; if another key varies, its first value
    std::string path = {};      ///< path of the varied key
    double confidence = 0.95;
    std::optional<double> margin;       ///< equivalence margin, in the metric's unit
    std::vector<ComparedModel> models;  ///< models in the order of the study
    RunCounts runs;                     ///< numbers of runs of all models, by state
    /// Text on keys that [study] of the scenario file varies, but that are fixed in this
    /// comparison, with their fixed values; empty: no such keys.
    std::string held = {};
    /// Text on protocols that send messages of the scenario over one hop only; empty: there are
    /// none.
    std::string one_hop = {};
    std::vector<PairedVariance> pairs;
    std::string cost_text = {};  ///< text on how costs were measured and whether they matter
};

/// Index of the baseline among the compared models.
/// @throws std::invalid_argument if the baseline is not one of the models
std::size_t place_of(const std::string& baseline, const std::vector<std::string>& models);

/// Key of the routing protocol. `compare --protocols` compares the values of this key.
inline constexpr std::string_view protocol_path = "routing.protocol";
/// Key of the propagation model. `compare --models` compares the values of this key.
inline constexpr std::string_view model_path = "propagation.model";

/// Name of a compared value: "friis" for the key propagation.model, "aodv" for routing.protocol,
/// "ttl=4" for other keys.
std::string compared_name(const std::string& path, const Value& value);

/// Compares the values of the only varied key of a study, such as propagation models. Two models
/// are compared over replications in which both have a value of the metric. The most detailed model
/// is the last one in the list of `rovernet models`, so that errors do not depend on the speed of a
/// machine. If the varied key is not propagation.model, errors are differences to the first value.
/// @param  baseline  name of a model; empty: the most detailed model
/// @param  margin    > 0, in the metric's unit: largest difference to the baseline that counts as
///                   equivalent; none: no test of equivalence
/// @throws std::invalid_argument if the metric or the baseline is unknown
Comparison compare_models(const Store& store, const std::string& metric,
                          const std::string& baseline, std::optional<double> margin = {});
/// Compares the models of a study in each of several metrics. The intervals of all differences in
/// all metrics together cover their true values with the given confidence (Bonferroni).
std::vector<Comparison> comparisons_of(const Store& store, const std::vector<std::string>& metrics,
                                       const std::string& baseline,
                                       std::optional<double> margin = {});

}  // namespace rovernet
