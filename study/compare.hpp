// SPDX-License-Identifier: MIT
#pragma once

#include "study/comparison.hpp"
#include "study/store.hpp"
#include "study/summary.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rovernet {

/// One propagation model among those that are compared over the same replications.
struct ComparedModel {
    std::string model;
    Summary summary;                   ///< of the metric
    std::optional<double> half_width;  ///< of its interval; nothing for one replication
    double cpu_s = 0;                  ///< [s] mean per run
    /// Mean over the replications of the distance to the dearest model's value, in the metric's
    /// unit, and half the width of its interval.
    double error = 0;
    std::optional<double> error_half_width;
    /// This one less the baseline; nothing for the baseline itself or fewer than 2 replications.
    std::optional<PairedComparison> difference;
    double holm_p = 1;     ///< of the difference, adjusted for all that are compared
    std::string sentence;  ///< the difference in words; empty without one
};

/// By how much common random numbers pay between two models.
struct PairedVariance {
    std::string a, b;
    std::optional<double> ratio;  ///< see PairedComparison::variance_ratio
};

struct Comparison {
    std::string metric, baseline, dearest;
    double confidence = 0.95;
    std::vector<ComparedModel> models;  ///< as in the study
    std::vector<PairedVariance> pairs;
};

/// Compares the models of a store whose study varies propagation.model alone, over the replications
/// in which all of them have a value. The dearest model is the last of them on the ladder of
/// `rovernet models`: what is said of errors does not depend on how fast a machine is.
/// @param baseline  one of the models; the dearest if empty
/// @throws std::invalid_argument if a model has no value, or the baseline is none of them
Comparison compare_models(const Store& store, const std::string& metric,
                          const std::string& baseline);

}  // namespace rovernet
