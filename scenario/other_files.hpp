// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace rovernet {

/// Refuses a file of a known kind that is not a scenario, such as a trace, a map or a store. The
/// kind follows from the ending of the file's name or from the first bytes of its content.
/// @throws InputError that names the kind and the command for this kind
void refuse_other_files(const std::string& path);

}  // namespace rovernet
