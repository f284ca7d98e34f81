// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"
#include "scenario/scenario.hpp"
#include "study/calibration/known_links.hpp"

#include <string>

// Levels that were measured in two buildings, as known links; their README tells how. The folder
// has flat/ (cells.csv, anchors.csv, map.yaml) and lab/ (links.csv, sensors.csv).

namespace rovernet {

/// Levels of a building: what models are fitted to, and another drive or day to check them on.
struct MeasuredBuilding {
    std::string name;
    Scenario scenario;
    KnownLinks first, second;
};

/// A furnished flat: a robot's tag heard by six anchors, local means of half a metre; the second
/// set is another drive. @throws InputError if a file is missing or damaged
MeasuredBuilding measured_flat(const std::string& folder);
/// An open laboratory: a beacon heard by twelve sensors, medians of half an hour; the second set is
/// another day.
MeasuredBuilding measured_lab(const std::string& folder);

/// Error of a model's losses in a building, root mean square [dB], without that of the levels
/// themselves: with its one constant fitted to the first set, judged on the second.
Db error_against(const MeasuredBuilding& building, const Propagation& model);

}  // namespace rovernet
