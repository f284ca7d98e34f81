// SPDX-License-Identifier: MIT
#pragma once

#include "routing/flood.hpp"

#include <tuple>

namespace rovernet {

/// Routing protocols that scenario files can name.
using RoutingProtocols = std::tuple<Flood>;

}  // namespace rovernet
