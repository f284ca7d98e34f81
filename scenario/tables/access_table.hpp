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

/// Reads the key eifs of [access]: a name of EifsRule. A boolean, as in files of earlier versions,
/// is also valid: true (standard), false (none).
/// @throws InputError for any other value
void read_value(const Value& value, std::string_view key, EifsRule& out);

/// [access]: the chosen medium access model, and the parameters of all such models. Parameters of a
/// model that is not chosen are checked and kept.
using AccessTable = ModelChoice<AccessModels, AccessModel>;

/// Default radio of a scenario: usual_radio() of the access model if the model has this function,
/// or else the defaults of Radio. Keys of [radio] override the default radio.
Radio usual_radio(const AccessTable& access);

}  // namespace rovernet
