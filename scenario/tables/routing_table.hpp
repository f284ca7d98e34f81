// SPDX-License-Identifier: MIT
#pragma once

#include "routing/list.hpp"
#include "scenario/tables/model_choice.hpp"
#include "sim/router.hpp"

#include <string>
#include <vector>

// Routing protocols in a scenario file:
//
//     [routing]
//     protocol = "flood"
//     ttl = 3

namespace rovernet {

/// [routing]: the chosen routing protocol, by default flood, and the given parameters of all listed
/// protocols. make() returns the protocol for Network::route().
using RoutingTable = ModelChoice<RoutingProtocols, Router>;

/// Names of the roles that robots may have in the chosen routing protocol, see RouterTraits::roles.
inline std::vector<std::string> roles_of(const RoutingTable& routing) {
    std::vector<std::string> roles;
    routing.for_each([&]<class M>(const M&, bool chosen) {
        if constexpr (requires { M::roles; }) {
            if (chosen) roles.assign(M::roles.begin(), M::roles.end());
        }
    });
    return roles;
}
/// Names of the roles of all routing protocols. The key `role` of a robot may have any of these
/// values, whatever protocol the file chooses.
inline std::vector<std::string> all_roles() {
    std::vector<std::string> roles;
    RoutingTable::for_each_type([&]<class M>() {
        if constexpr (requires { M::roles; }) {
            roles.insert(roles.end(), M::roles.begin(), M::roles.end());
        }
    });
    return roles;
}

}  // namespace rovernet
