// SPDX-License-Identifier: MIT
#pragma once

#include "sim/router.hpp"

namespace rovernet {

/// Router that only describes control packets (Router::describe), for records that were read from a
/// file: the packets of any protocol of RoutingProtocols, from their kinds and bytes.
const Router& packet_describer();

}  // namespace rovernet
