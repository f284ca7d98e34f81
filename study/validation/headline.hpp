// SPDX-License-Identifier: MIT
#pragma once

#include "study/validation/validation.hpp"

#include <string>

namespace rovernet {

/// Picture that shows which propagation model is good enough, as SVG. For each scene of the chart
/// `path_loss`, the picture has the models in the order of cost, each with its error as given and
/// its error after fitting. In each scene the model with the smallest error is highlighted, forms
/// of the reference excepted. A model is left out if an earlier model of the chart has the same
/// errors, such as two_ray in an office, where two_ray equals free space.
/// @throws std::out_of_range if the validation has no such chart
std::string headline_svg(const Validation& validation);

}  // namespace rovernet
