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

// List of propagation models: a new model is a header and a line here.

namespace rovernet {

/// Propagation models that scenario files can name, in the order of detail. For a model in this
/// list the reader, range checks, printing, documentation, conformance tests and sweeps follow from
/// its fields(). `rovernet compare` treats the compared model with the last place in this list as
/// the most detailed one.
using PropagationModels = std::tuple<Disc, Friis, TwoRay, ItuIndoor, LogDistance, ItuSiteGeneral,
                                     MultiWall, Raytrace2007, Rays>;

/// Calls `visit.template operator()<Model>()` for each model of PropagationModels, in order:
///
///   for_each_model([&]<class Model>() { names.emplace_back(Model::name); });
template <class Visitor>
constexpr void for_each_model(Visitor&& visit) {
    [&]<class... Models>(std::tuple<Models...>*) {
        (visit.template operator()<Models>(), ...);
    }(static_cast<PropagationModels*>(nullptr));
}

}  // namespace rovernet
