// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/stage/worldfile.hpp"

#include <string>
#include <vector>

// Robots of Stage worlds: "NAME.world" is a scenario without a scenario file.

namespace rovernet {

/// Scenario document with the robots of a Stage world; every value has its position in the world
/// file. The document has no [scene].
///
/// [[robot]]: every `position` of the world, at any depth, with
///
///   name         name in the world, or else robot0, robot1, ... by the number of the robot; "_" is
///                appended to a name that an earlier robot has, with a notice
///   at, heading  pose, including the poses of the models that carry it; z is dropped
///   radius       half the smaller side of the robot's size
///   radio        keys of the robot's first wifi; without a wifi the keys of [radio], with one
///                notice for all robots
///   propagation  model of the wifi, and its parameters of any model; without a model the model of
///                [propagation], with a notice
///   scan         list of the robot's range finders, see stage_scanners()
///
/// [scenario]: duration from quit_time, if above 0, and seed from the last random_seed, if the
/// world gives them.
///
/// @param notices  receives notices "file:line: text" about ignored or odd keys, each once
/// @throws InputError for a value of the wrong kind
Table stage_document(const WorldFile& world, std::vector<std::string>& notices);

}  // namespace rovernet
