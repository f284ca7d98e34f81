// SPDX-License-Identifier: MIT
#pragma once

#include "models/disc.hpp"
#include "models/friis.hpp"
#include "models/itu_indoor.hpp"
#include "models/log_distance.hpp"
#include "models/raytrace_2007.hpp"
#include "models/two_ray.hpp"

#include <tuple>

namespace rovernet {

/// The propagation models that scenario files know by name, cheapest first.
using PropagationModels = std::tuple<Disc, Friis, TwoRay, ItuIndoor, LogDistance, Raytrace2007>;

/// Calls `visit.template operator()<Model>()` for each listed model.
template <class Visitor>
constexpr void for_each_model(Visitor&& visit) {
    [&]<class... Models>(std::tuple<Models...>*) {
        (visit.template operator()<Models>(), ...);
    }(static_cast<PropagationModels*>(nullptr));
}

}  // namespace rovernet
