// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

#include <string>

namespace rovernet {

/// Text of a model's name and parameters, "log_distance: exponent 4, sigma 5 dB"; only the name if
/// scenario files do not support the model. Shadowing is appended: "friis, with shadowing: model
/// link, sigma 3 dB, decorrelation_distance 10 m".
std::string model_text(const Propagation& model);

}  // namespace rovernet
