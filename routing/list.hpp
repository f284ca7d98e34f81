// SPDX-License-Identifier: MIT
#pragma once

#include "routing/aodv.hpp"
#include "routing/dsr.hpp"
#include "routing/flood.hpp"
#include "routing/managed.hpp"
#include "routing/suppression.hpp"

#include <tuple>

namespace rovernet {

/// Routing protocols that scenario files can name.
using RoutingProtocols = std::tuple<Flood, Aodv, Dsr, Suppression, Managed>;

}  // namespace rovernet
