// SPDX-License-Identifier: MIT
#pragma once

#include "scene/scene.hpp"

#include <string>

namespace rovernet {

/// Digest of the walls and ceilings of a scene, with their materials: 16 hexadecimal digits
/// (XXH64). Scenes with different walls have different digests.
std::string wall_digest(const Scene& scene);

}  // namespace rovernet
