// SPDX-License-Identifier: MIT
#pragma once

#include "routing/list.hpp"
#include "sim/router.hpp"

#include <cstddef>

// Routing protocols as a scenario file gives them:
//
//     [routing]
//     protocol = "flood"
//     ttl = 3

namespace rovernet {

/// [routing]: the chosen protocol, and the parameters that were given for any listed one. A key
/// that several protocols have is given to all.
struct RoutingTable {
    /// Index into RoutingProtocols; by default flood.
    std::size_t protocol = 0;
    /// One struct for each listed protocol, with its parameters.
    RoutingProtocols parameters;

    /// Chosen protocol, ready for Network::route().
    /// @throws std::invalid_argument if a parameter is out of its range
    Router make() const;
};

}  // namespace rovernet
