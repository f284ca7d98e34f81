// SPDX-License-Identifier: MIT
#pragma once

#include "routing/list.hpp"
#include "sim/router.hpp"

#include <cstddef>

// Routing protocols in a scenario file:
//
//     [routing]
//     protocol = "flood"
//     ttl = 3

namespace rovernet {

/// [routing]: the chosen protocol, and the given parameters of all listed protocols. A key that
/// several protocols share sets the parameter of each.
struct RoutingTable {
    /// Index of the chosen protocol in RoutingProtocols; by default flood.
    std::size_t protocol = 0;
    /// Parameters of each listed protocol, one struct for each.
    RoutingProtocols parameters;

    /// Chosen protocol, ready for Network::route().
    /// @throws std::invalid_argument if a parameter is out of its range
    Router make() const;
};

}  // namespace rovernet
