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

/// Parameter of a propagation model that a fit to known losses can determine, see Fit.
struct FreeParameter {
    std::string_view model, key;
    std::string_view unit = "";  ///< unit of the parameter; empty: a number without unit
    Fit fit = {};                ///< way in which a fit determines the parameter; with_bases() sets
                                 ///< Fit::base
    bool non_negative = false;   ///< true: negative values of the parameter are out of range
};

/// Parameters of the propagation model with the name `model` that a fit can determine. Most models
/// have no such parameters.
std::vector<FreeParameter> free_parameters(std::string_view model);
/// Key of the parameter of a propagation model that a fit determines in the way `way`; empty if the
/// model has no such parameter. Example: "range" of `disc`, by the number of wrong decisions.
std::string_view key_determined(std::string_view model, Fit::Way way);

/// Propagation model with the scenario's parameters, overridden by `values`, and with median losses
/// in place of random draws.
/// @param values  values of free parameters by key, in the units of FreeParameter
/// @throws InputError as read_propagation()
Propagation model_with(const Scenario& scenario, std::string_view model,
                       const std::map<std::string, double>& values);

/// Copy of free parameters with suitable bases (Fit::base). Bases of parameters that need a search
/// are found by a compass search, which minimises the squared error in dB on a sample of the links.
/// An unseen link (nothing received) counts only if the predicted loss is below the link's lower
/// bound. Measured links have a free constant. Parameters of which the loss is a linear function
/// keep their bases.
/// @throws InputError, std::invalid_argument if the model cannot be evaluated
std::vector<FreeParameter> with_bases(std::vector<FreeParameter> free, const KnownLinks& known,
                                      const Scenario& scenario);

/// Loss [dB] of one link as a linear function of a model's free parameters b_j: offset + sum over j
/// of columns[j] * b_j.
struct LinearLoss {
    double offset = 0;  ///< loss if all free parameters are 0 [dB]
    std::vector<double> columns;
};

/// Losses of all links as linear functions of a model's free parameters. They are found by
/// evaluating the model at the base of each parameter, and one unit above the base.
/// @throws InputError, std::invalid_argument if the model cannot be evaluated
std::vector<LinearLoss> linear_losses(const KnownLinks& known, const Scenario& scenario,
                                      std::string_view model, std::span<const FreeParameter> free);

}  // namespace rovernet
