// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv.hpp"
#include "routing/flood.hpp"
#include "routing/managed.hpp"
#include "routing/suppression.hpp"

#include <tuple>

namespace rovernet {

/// Routing protocols that scenario files can name.
using RoutingProtocols = std::tuple<Flood, Aodv, Suppression, Managed>;

}  // namespace rovernet
