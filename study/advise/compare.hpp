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

/// Propagation model, or value of any varied key, in a comparison over common random numbers.
struct ComparedModel {
    std::string model;  ///< name of the model or value: "friis", "ttl=4"
    Answer answer;      ///< mean of the metric over all replications of this model, see answers()
    double cpu_s = 0;   ///< mean CPU time of a run [s]
    std::optional<MediumCost> cost;  ///< CPU cost of the medium; see add_costs()
    /// Approximate share of the medium's CPU time in the CPU time of the runs [-].
    std::optional<double> radio_share;
    /// Mean absolute difference to the most detailed model, in the metric's unit, over replications
    /// in which both have a value; 0 for the most detailed model itself.
    std::optional<double> error;
    /// Confidence interval of `error`, see interval_of(); none for the most detailed model.
    std::optional<MeanInterval> error_interval;
    /// Number of replications over which `error` is the mean.
    std::size_t error_n = 0;
    /// Difference of this model to the baseline, over replications in which both have a value; none
    /// for the baseline itself, or for fewer than 2 replications.
    std::optional<PairedComparison> difference;
    Gaps unpaired;         ///< number of replications without a value of both models, by reason
    std::string sentence;  ///< `difference` as a sentence; empty without a difference
    /// Verdict whether the difference to the baseline lies within Comparison::margin; none without
    /// a margin or a difference.
    std::optional<EquivalenceVerdict> equivalence;
    std::string equivalence_sentence;  ///< `equivalence` as a sentence; empty without a verdict
};

/// Variance reduction by common random numbers between two models.
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
    /// Text on the keys that [study] of the scenario file varies but the comparison does not, with
    /// their fixed values; empty: none.
    std::string held = {};
    std::vector<PairedVariance> pairs;
    std::string cost_text = {};  ///< text on how costs were measured, and whether they matter
};

/// Index of the baseline among the compared models.
/// @throws std::invalid_argument if the baseline is not one of the models
std::size_t place_of(const std::string& baseline, const std::vector<std::string>& models);

/// Key of the routing protocol, whose values `compare --protocols` sets side by side.
inline constexpr std::string_view protocol_path = "routing.protocol";
/// Key of the propagation model, whose values `compare --models` sets side by side.
inline constexpr std::string_view model_path = "propagation.model";

/// Name of a compared value: "friis" for the key propagation.model, "aodv" for routing.protocol,
/// "ttl=4" for other keys.
std::string compared_name(const std::string& path, const Value& value);

/// Compares the values of the only varied key of a study, such as propagation models. Two models
/// are compared over replications in which both have a value of the metric. The most detailed model
/// is the last one in the list of `rovernet models`, so that errors do not depend on the speed of a
/// machine. If the key is not propagation.model, errors are differences to the first value.
/// @param  baseline  name of a model; empty: the most detailed model
/// @param  margin    > 0, in the metric's unit: largest difference to the baseline that counts as
///                   equivalent; none: no test of equivalence
/// @throws std::invalid_argument if the metric or the baseline is unknown
Comparison compare_models(const Store& store, const std::string& metric,
                          const std::string& baseline, std::optional<double> margin = {});
/// Compares in several metrics. The intervals of the differences in all metrics hold together: the
/// family of each is all of them.
std::vector<Comparison> comparisons_of(const Store& store, const std::vector<std::string>& metrics,
                                       const std::string& baseline,
                                       std::optional<double> margin = {});

}  // namespace rovernet
