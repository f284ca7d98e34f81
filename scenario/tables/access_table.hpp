// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/list.hpp"
#include "models/radio.hpp"
#include "scenario/tables/model_choice.hpp"

#include <string_view>

// Medium access in a scenario file:
//
//     [access]
//     model = "csma"
//     standard = "802.11g"
//     basic_rates = ["6 Mb/s"]

namespace rovernet {

/// Reads [access] eifs: a name of EifsRule, or a boolean as in files of earlier versions: true
/// (standard), false (none).
/// @throws InputError for anything else
void read_value(const Value& value, std::string_view key, EifsRule& out);

/// [access]: the chosen model, and the parameters of all models. Parameters of a model that is not
/// chosen are checked and kept.
using AccessTable = ModelChoice<AccessModels, AccessModel>;

/// Radio without keys of its own: that of the access model if it has one (usual_radio()), or else
/// Radio's defaults. [radio] changes it.
Radio usual_radio(const AccessTable& access);

}  // namespace rovernet
