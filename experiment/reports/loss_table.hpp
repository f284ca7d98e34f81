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

/// Heights of the antennas above the ground [m], >= 0.
struct LossAntennas {
    Meters from, to;
};

/// Median path loss (shadowing off) of a listed model over distance.
/// @param parameters  "name=value" each; parameters that are not given take the model's defaults
/// @param distances   [m] horizontal
/// @param wall        [m] length of the path inside walls
/// @throws InputError with the name of the wrong option instead of a file
std::vector<LossRow> loss_table(const std::string& model,
                                const std::vector<std::string>& parameters, Hertz frequency,
                                const std::vector<Meters>& distances, LossAntennas heights,
                                Meters wall);

/// Quantity from the command line: text with a unit, or a bare number in SI units.
/// @throws InputError with `option` instead of a file
Hertz option_frequency(const std::string& option, const std::string& text);
Meters option_length(const std::string& option, const std::string& text);
Duration option_time(const std::string& option, const std::string& text);

/// List of propagation models: name, and name, default, range and meaning of each parameter.
Array list_models();
/// List of shadowing and fading models, which vary the loss of any propagation model; in the form
/// of list_models().
Array list_variations();

}  // namespace rovernet
