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

/// [reception]: the chosen model of frame reception, and the parameters of all such models. As
/// parameters of other models are checked and kept, changing the key `model` swaps the model.
using ReceptionTable = ModelChoice<ReceptionModels, ReceptionModel>;

}  // namespace rovernet
