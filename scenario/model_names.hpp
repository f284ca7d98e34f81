// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

namespace rovernet {

/// Names of all models and protocols that a scenario file can choose: a list of names for each
/// table that chooses one (propagation, shadowing, fading, reception, access, routing), and for the
/// key `move` of a robot.
Table model_names();

}  // namespace rovernet
