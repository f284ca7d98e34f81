// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

namespace rovernet {

/// JSON Schema (draft 4) of scenario files, for editors: every table and key, with its meaning,
/// type, units and words. The schema accepts every file that read_scenario() accepts. The schema
/// does not check values that depend on other keys or files, such as names of robots. It checks the
/// limits of numbers, but not of quantities.
///
/// Tables and keys follow from the lists of models and from the fields() by which they are read.
Table scenario_schema();

}  // namespace rovernet
