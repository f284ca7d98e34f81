// SPDX-License-Identifier: MIT
#pragma once

#include "routing/list.hpp"
#include "sim/router.hpp"

#include <cstddef>

namespace rovernet {

/// [routing]: the chosen protocol, and the parameters given for any listed one.
struct RoutingTable {
    std::size_t protocol = 0;  ///< index into RoutingProtocols
    RoutingProtocols parameters;

    /// @throws std::invalid_argument if a parameter is out of its range
    Router make() const;
};

}  // namespace rovernet
