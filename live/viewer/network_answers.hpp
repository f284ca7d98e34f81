// SPDX-License-Identifier: MIT
#pragma once

#include "network/network.hpp"
#include "scenario/document/value.hpp"
#include "sim/ids.hpp"

#include <optional>

namespace rovernet {

/// Links of a network now, as the answer to the page's question `links` (docs/view-format.md): all
/// links, or those from and to the robot `of`.
/// @throws RunError for more links, or more robots, than a picture can show
Table answer_links(const Network& network, std::optional<NodeId> of);

}  // namespace rovernet
