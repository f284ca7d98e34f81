// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/disc.hpp"
#include "models/propagation/friis.hpp"
#include "models/propagation/itu_indoor.hpp"
#include "models/propagation/itu_site_general.hpp"
#include "models/propagation/log_distance.hpp"
#include "models/propagation/multi_wall.hpp"
#include "models/propagation/rays.hpp"
#include "models/propagation/raytrace_2007.hpp"
#include "models/propagation/two_ray.hpp"

#include <tuple>

// The list of propagation models: a new one is a header and a line here.

namespace rovernet {

/// Propagation models that scenario files know by name, in the order of their detail. A model that
/// is added here is read, checked, printed, documented, tested for conformance and swept: all of
/// that follows from its fields(). `rovernet compare` takes the last of those that it compares as
/// the most detailed one.
using PropagationModels = std::tuple<Disc, Friis, TwoRay, ItuIndoor, LogDistance, ItuSiteGeneral,
                                     MultiWall, Raytrace2007, Rays>;

/// Calls `visit.template operator()<Model>()` for each listed model, in that order:
///
///   for_each_model([&]<class Model>() { names.emplace_back(Model::name); });
template <class Visitor>
constexpr void for_each_model(Visitor&& visit) {
    [&]<class... Models>(std::tuple<Models...>*) {
        (visit.template operator()<Models>(), ...);
    }(static_cast<PropagationModels*>(nullptr));
}

}  // namespace rovernet
