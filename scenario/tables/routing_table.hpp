// SPDX-License-Identifier: MIT
#pragma once

#include "routing/list.hpp"
#include "scenario/tables/model_choice.hpp"
#include "sim/router.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Names of the roles of all routing protocols. The key `role` of a robot may have any of these
/// values, for any protocol that the file chooses.
inline std::vector<std::string> all_roles() {
    std::vector<std::string> roles;
    RoutingTable::for_each_type([&]<class M>() {
        if constexpr (requires { M::roles; }) {
            roles.insert(roles.end(), M::roles.begin(), M::roles.end());
        }
    });
    return roles;
}

/// Role of a robot under a protocol with the given roles: `given` if it is one of `roles`, or else
/// empty (no role, or a role of a different protocol).
inline std::string role_under(std::span<const std::string_view> roles,
                              const std::optional<std::string>& given) {
    const std::string role = given.value_or("");
    return std::find(roles.begin(), roles.end(), role) == roles.end() ? "" : role;
}

}  // namespace rovernet
