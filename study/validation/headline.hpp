// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/validation.hpp"

#include <string>

namespace rovernet {

/// Picture on the question which model is good enough, as SVG: for each scene of the chart
/// `path_loss` the models in the order of cost, each with its error as given and fitted. The
/// nearest model of each scene that is no form of the reference is highlighted, with its error. A
/// model with the same errors as one before it in the chart (such as two_ray in an office, which is
/// free space there) is left out.
/// @throws std::out_of_range if the validation has no such chart
std::string headline_svg(const Validation& validation);

}  // namespace rovernet
