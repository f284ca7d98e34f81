// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <string>
#include <string_view>

namespace rovernet {

/// The version of the library, such as "0.1.0".
std::string_view version();

/// Version that decides results: version and commit, such as "0.1.0 (4f1c...)"; if the sources
/// differed from the commit or it is not known, with XXH64 of the running program.
const std::string& code_version();

/// Build of the program: version, commit, dirty, compiler, type, flags.
Table build_provenance();

}  // namespace rovernet
