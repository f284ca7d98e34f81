// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

#include <string>

namespace rovernet {

/// A model's name and parameters, "log_distance: exponent 4, sigma 5 dB"; the name alone of a model
/// that scenario files do not know.
std::string model_text(const Propagation& model);

}  // namespace rovernet
