// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <string>
#include <vector>

namespace rovernet {

struct LossRow {
    Meters distance;
    Db loss;
};

/// Heights above the ground of the sender's and the receiver's antenna [m], >= 0.
struct LossAntennas {
    Meters from, to;
};

/// Median path loss (without shadowing) of a propagation model at several distances.
/// @param model       name of the model, see list_models()
/// @param parameters  texts "name=value"; parameters that are not given have the model's defaults
/// @param distances   horizontal distances [m]
/// @param wall        length of the path inside walls [m]
/// @throws InputError that names the wrong option in place of a file
std::vector<LossRow> loss_table(const std::string& model,
                                const std::vector<std::string>& parameters, Hertz frequency,
                                const std::vector<Meters>& distances, LossAntennas heights,
                                Meters wall);

/// Conversion of the text of a command-line option to a quantity. The text is a number with a unit,
/// or a bare number in SI units.
/// @throws InputError that names `option` in place of a file
Hertz option_frequency(const std::string& option, const std::string& text);
Meters option_length(const std::string& option, const std::string& text);
Duration option_time(const std::string& option, const std::string& text);

/// List of all propagation models: for each model its name, and the name, default, range and
/// meaning of each parameter.
Array list_models();
/// List of shadowing and fading models, which vary the loss of any propagation model. Each entry
/// has the keys of list_models().
Array list_variations();

}  // namespace rovernet
