// SPDX-License-Identifier: MIT
#pragma once

#include "routing/flood.hpp"

#include <tuple>

namespace rovernet {

/// The routing protocols that scenario files know by name.
using RoutingProtocols = std::tuple<Flood>;

}  // namespace rovernet
