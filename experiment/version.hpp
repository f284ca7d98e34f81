// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/value.hpp"

#include <string>
#include <string_view>

namespace rovernet {

/// Version of this library, such as "0.1.0".
std::string_view version();

/// Version and commit of the code that computes results, such as "0.1.0 (4f1c...)". If the sources
/// differ from the commit, or the commit is unknown, the XXH64 hash of the running program is
/// appended.
const std::string& code_version();

/// Table of build information: version, commit, dirty (true if the sources differ from the commit),
/// compiler, build_type, flags.
Table build_provenance();

/// Current date and time (UTC), as "2025-06-30T23:59:59Z".
std::string utc_now();
/// Name of this machine.
std::string host_name();

}  // namespace rovernet
