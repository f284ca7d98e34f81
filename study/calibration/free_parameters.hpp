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

/// Parameter of a propagation model that a fit can find: its loss is linear in it, or nearly so
/// about a base that a search finds.
struct FreeParameter {
    std::string_view model, key;
    std::string_view unit = "";  ///< empty: a bare number
    double base = 0;             ///< value at which no loss is cut at 0, so that it is linear
    bool non_negative = false;   ///< true for the losses of walls
    bool searched = false;       ///< the loss is linear about the best value alone
};

/// The free parameters of a listed model; none for most.
std::vector<FreeParameter> free_parameters(std::string_view model);

/// A listed model with the scenario's parameters, but with these; without its random part.
/// @param values  by key, in the units of FreeParameter
/// @throws InputError as read_propagation()
Propagation model_with(const Scenario& scenario, std::string_view model,
                       const std::map<std::string, double>& values);

/// The parameters with those bases near which a model comes nearest to the links: a compass search,
/// on a sample of them, for the least squared error in dB; what was not seen counts where it is
/// predicted to be seen, and measured links have a constant of their own. Those whose loss is
/// linear keep their bases.
/// @throws InputError, std::invalid_argument if the model cannot be asked
std::vector<FreeParameter> with_bases(std::vector<FreeParameter> free, const KnownLinks& known,
                                      const Scenario& scenario);

/// What a model says of one link: its loss is offset + sum over j of columns[j] b_j, with its free
/// parameters b.
struct LinearLoss {
    double offset = 0;  ///< [dB]
    std::vector<double> columns;
};

/// The losses of links as linear functions of a model's free parameters, found by asking the model
/// at values one apart.
/// @throws InputError, std::invalid_argument if the model cannot be asked
std::vector<LinearLoss> linear_losses(const KnownLinks& known, const Scenario& scenario,
                                      std::string_view model, std::span<const FreeParameter> free);

}  // namespace rovernet
