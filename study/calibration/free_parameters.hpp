// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"
#include "study/calibration/known_links.hpp"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rovernet {

/// Parameter of a propagation model that a fit can determine: the loss is linear in it, or
/// approximately linear near a base value, which is searched for.
struct FreeParameter {
    std::string_view model, key;
    std::string_view unit = "";  ///< unit of the parameter; empty: a bare number
    double base = 0;  ///< base value, at which no loss is clipped at 0, so that the loss is linear
    bool non_negative = false;  ///< true for the losses of walls, which are >= 0
    /// True: the loss is linear only near the best value, which is searched for.
    bool searched = false;
};

/// Free parameters of a propagation model, by its name; most models have none.
std::vector<FreeParameter> free_parameters(std::string_view model);

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
