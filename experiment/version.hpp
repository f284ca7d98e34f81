// SPDX-License-Identifier: MIT
#pragma once

#include "experiment/value.hpp"

#include <string_view>

namespace rovernet {

/// The version of the library, such as "0.1.0".
std::string_view version();

/// What was built: version, commit, dirty, compiler, type, flags.
Table build_provenance();

}  // namespace rovernet
