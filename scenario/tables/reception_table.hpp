// SPDX-License-Identifier: MIT
#pragma once

#include "models/reception/list.hpp"
#include "scenario/tables/model_choice.hpp"

// Reception of frames in a scenario file:
//
//     [reception]
//     model = "collision"
//     capture_ratio = "10 dB"

namespace rovernet {

/// [reception]: the chosen model, and the parameters of all models. Parameters of a model that is
/// not chosen are checked and kept, so that changing the key `model` is enough to swap the model.
using ReceptionTable = ModelChoice<ReceptionModels, ReceptionModel>;

}  // namespace rovernet
