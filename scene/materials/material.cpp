// SPDX-License-Identifier: MIT
#include "scene/materials/material.hpp"

namespace rovernet {

WallRate wall_rate(const Material& material, Hertz frequency, double usual_per_metre) {
    if (material.follows_model()) return {.per_metre = usual_per_metre};
    WallRate rate;
    if (material.slab)
        rate.per_crossing = slab_loss(*material.slab, material.thickness, frequency).value;
    if (material.per_crossing) rate.per_crossing = material.per_crossing->value;
    if (material.per_metre) rate.per_metre = material.per_metre->value;
    return rate;
}

}  // namespace rovernet
