// SPDX-License-Identifier: MIT
#pragma once

#include "models/access/aloha.hpp"
#include "models/access/csma.hpp"
#include "models/access/no_access.hpp"

#include <tuple>

// List of access models: a new model is a header and a line here.

namespace rovernet {

/// Access models that scenario files can name, in ascending order of computing time; the first one
/// is the default. An access model determines when nodes may transmit. Reading, range checks and
/// printing of its settings follow from its fields().
using AccessModels = std::tuple<NoAccess, Aloha, Csma>;

}  // namespace rovernet
