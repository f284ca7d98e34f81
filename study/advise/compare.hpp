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
    Answer answer;      ///< value of the metric over all replications of this model, as in results
    double cpu_s = 0;   ///< mean CPU time of a run [s]
    std::optional<MediumCost> cost;  ///< CPU cost of the medium; see add_costs()
    /// Approximate share of the medium's cost in the runs' CPU time [-].
    std::optional<double> radio_share;
    /// Mean absolute difference to the most detailed model, in the metric's unit, over replications
    /// in which both have a value; 0 for the most detailed model itself.
    std::optional<double> error;
    /// Confidence interval of `error`, see interval_of(); none for the most detailed model.
    std::optional<MeanInterval> error_interval;
    /// Number of replications in `error`.
    std::size_t error_n = 0;
    /// Difference of this model to the baseline, over replications in which both have a value; none
    /// for the baseline itself, or for fewer than 2 replications.
    std::optional<PairedComparison> difference;
    Gaps unpaired;  ///< number of replications missing in `difference`, since a model has no value
    std::string sentence;  ///< `difference` as a sentence; empty without a difference
    /// Verdict whether the difference lies within the margin, if a margin is given; and the verdict
    /// as a sentence.
    std::optional<EquivalenceVerdict> equivalence;
    std::string equivalence_sentence;
};

/// Variance reduction by common random numbers between two models.
struct PairedVariance {
    std::string a, b;
    std::optional<double> ratio;  ///< variance ratio [-], see paired_variance_ratio()
};

struct Comparison {
    std::string metric, baseline;
    std::string most_detailed;  ///< most detailed model; if another key varies, its first value
    std::string path = {};      ///< varied key, by path
    double confidence = 0.95;
    std::optional<double> margin;       ///< equivalence margin, in the metric's unit
    std::vector<ComparedModel> models;  ///< models in the order of the study
    RunCounts runs;                     ///< runs of all models
    /// Other varied keys of the study, with the values at which they are fixed.
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

/// Compares the models of a study that varies only propagation.model, or the values of its only
/// varied key. Each pair is compared over replications in which both have a value. The most
/// detailed model is the last one in the list of `rovernet models`, so that errors do not depend on
/// the speed of a machine. For other keys, errors are differences to the first value.
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
