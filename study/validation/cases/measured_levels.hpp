// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"
#include "study/calibration/known_links.hpp"

#include <string>

// Levels measured in two buildings, as links of known loss. The folder of the measurements has
// flat/ (cells.csv, anchors.csv, map.yaml) and lab/ (links.csv, sensors.csv), and a README that
// describes the measurements.

namespace rovernet {

/// Levels measured in a building. Models are fitted to the first set and checked on the second set
/// (a different drive or day).
struct MeasuredBuilding {
    std::string name;
    Scenario scenario;
    KnownLinks first, second;
};

/// Levels measured in a furnished flat: a robot's tag received by six anchors (receivers of known
/// position), averaged over 0.5 m. The second set is a different drive. @throws InputError if a
/// file is missing or damaged
MeasuredBuilding measured_flat(const std::string& folder);
/// Levels measured in an open laboratory: a beacon received by twelve sensors, medians over half an
/// hour. The second set is a different day.
MeasuredBuilding measured_lab(const std::string& folder);

/// Root mean square error [dB] of a model in a building, after subtraction of the measurement error
/// of levels. The model's constant is fitted to the first set of levels. The error is computed on
/// the second set.
Db error_against(const MeasuredBuilding& building, const Propagation& model);

}  // namespace rovernet
