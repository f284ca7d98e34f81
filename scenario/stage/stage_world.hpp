// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"
#include "scene/stage/worldfile.hpp"

#include <string>
#include <vector>

// Robots of Stage worlds: "NAME.world" is a scenario without a scenario file.

namespace rovernet {

/// Document of a scenario with the robots of a Stage world, every value with its place in the
/// world. The scene is not in it.
///
/// [[robot]]: every `position` with a `wifi`, anywhere in the world, with
///
///   name         its own, else robot0, robot1, ... by its number among the robots
///   at, heading  its pose, those of the models that carry it applied; without z
///   radius       half the smaller side of its size
///   radio        what its wifi says; its first one, if it has several
///   propagation  its model and its parameters, those of other models too; without a model that
///                of [propagation] rules, with a notice
///   scan         what stage_scanners() makes of its lasers and rangers; a list
///
/// [scenario]: duration from quit_time, if above 0, and seed from the last random_seed, if the
/// world gives them.
///
/// @param notices  appended: what is ignored or odd, each once, "file:line: text"
/// @throws InputError for a value of the wrong kind and for two robots of one name
Table stage_document(const WorldFile& world, std::vector<std::string>& notices);

}  // namespace rovernet
