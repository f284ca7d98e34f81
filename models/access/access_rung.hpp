// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/aloha.hpp"
#include "models/access/dcf.hpp"

#include <variant>

namespace rovernet {

/// Access rung "none": frames go out at once, even over one another.
struct NoAccess {};

/// How nodes get access to the medium: the rungs, cheapest first.
using AccessRung = std::variant<NoAccess, Aloha, Csma>;

}  // namespace rovernet
