// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/value.hpp"
#include "scene/worldfile.hpp"

#include <string>
#include <vector>

namespace rovernet {

/// The robots of a Stage world as the document of a scenario, every value with its place in the
/// world: [[robot]] with its pose, size, radio and propagation from its wifi; [scenario] with
/// duration (quit_time) and seed (random_seed) if the world gives them. The scene is not in it.
/// @param notices  appended: what is ignored or odd, each once, with file and line
/// @throws InputError for a value of the wrong kind
Table stage_document(const WorldFile& world, std::vector<std::string>& notices);

}  // namespace rovernet
