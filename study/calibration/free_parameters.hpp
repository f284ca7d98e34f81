// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"
#include "sim/parameter.hpp"
#include "study/calibration/known_links.hpp"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Parameter of a propagation model that a fit can determine, as its field says.
struct FreeParameter {
    std::string_view model, key;
    std::string_view unit = "";  ///< unit of the parameter; empty: a bare number
    Fit fit = {};                ///< way in which it is determined; `base` is varied by a search
    bool non_negative = false;   ///< true: negative values are out of range
};

/// Free parameters of a propagation model, by its name; most models have none.
std::vector<FreeParameter> free_parameters(std::string_view model);
/// Key of the model's parameter that a fit determines in this way; empty: it has none.
std::string_view key_determined(std::string_view model, Fit::Way way);

/// Propagation model with the scenario's parameters, overridden by `values`, without random draws.
/// @param values  values by key, in the units of FreeParameter
/// @throws InputError as read_propagation()
Propagation model_with(const Scenario& scenario, std::string_view model,
                       const std::map<std::string, double>& values);

/// Parameters with searched bases: a compass search minimises the squared error in dB on a sample
/// of the links. Unseen links count only if the model predicts them as seen, and measured links
/// have a free constant. Parameters with linear loss keep their bases.
/// @throws InputError, std::invalid_argument if the model cannot be evaluated
std::vector<FreeParameter> with_bases(std::vector<FreeParameter> free, const KnownLinks& known,
                                      const Scenario& scenario);

/// Loss of one link as a linear function of the model's free parameters b: offset + sum over j of
/// columns[j] b_j.
struct LinearLoss {
    double offset = 0;  ///< loss for b = 0 [dB]
    std::vector<double> columns;
};

/// Losses of all links as linear functions of a model's free parameters, found by evaluating the
/// model at values one unit apart.
/// @throws InputError, std::invalid_argument if the model cannot be evaluated
std::vector<LinearLoss> linear_losses(const KnownLinks& known, const Scenario& scenario,
                                      std::string_view model, std::span<const FreeParameter> free);

}  // namespace rovernet
